#pragma once

#include <string>

#include "renderers/graph/graph.h"
#include "renderers/passes/viewers/tools.h"

namespace ir::passes::viewers {

/// Draws the world flat shaded, from the graph's buffers where it has them, else from its own, which it
/// keeps as long as the world stays the same.
class SceneMesh {
  public:
    explicit SceneMesh(const Tools& tools);
    ~SceneMesh();
    SceneMesh(const SceneMesh&) = delete;

    void draw(graph::Graph& graph, const graph::FrameInputs& inputs, const Sight& sight);

  private:
    struct Buffers {
        gl::Name positions = 0, indices = 0;
    };
    Buffers buffers(graph::Graph& graph, const graph::FrameInputs& inputs);
    Tools tools_;
    GLuint vertex_array_ = 0;
    DeviceStore positions_, indices_;
    std::string fingerprint_;  ///< of the geometry in the own buffers
};

}  // namespace ir::passes::viewers
