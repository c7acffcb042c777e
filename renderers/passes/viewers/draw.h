#pragma once

#include <memory>

#include "renderers/gl/program.h"
#include "renderers/graph/graph.h"
#include "renderers/passes/viewers/scene_3d.h"
#include "renderers/scene/world.h"

namespace ir::passes::viewers {

/// Draws 3D views of one graph's buffers. Holds what it uploaded of the world between pictures. One context,
/// which must be current.
class Viewer {
  public:
    Viewer(gl::Context& context, gl::Device& device, gl::ProgramLibrary& programs);
    ~Viewer();
    /// Reads the buffers where they are, on the device; `graph` has rendered at least one frame from
    /// `inputs`. Throws Error only for what OpenGL cannot do; unknown and unavailable layers are said in the
    /// picture.
    Picture3D draw(graph::Graph& graph, const graph::FrameInputs& inputs, const scene::Camera& camera,
                   const Scene3D& view);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace ir::passes::viewers
