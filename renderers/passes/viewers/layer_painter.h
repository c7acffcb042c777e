#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderers/passes/viewers/layer_plan.h"
#include "renderers/passes/viewers/target.h"
#include "renderers/passes/viewers/tools.h"

namespace ir::passes::viewers {

/// How many elements an invocation of a compute shader looks at.
inline constexpr unsigned elements_per_invocation = 16;

/// Measures and draws layers that are planned, straight from the buffers that hold them.
class LayerPainter {
  public:
    explicit LayerPainter(const Tools& tools);
    ~LayerPainter();
    LayerPainter(const LayerPainter&) = delete;

    /// Finds what the layers' elements span: their bounds, and the ranges of colours, which are written into
    /// the plans. Extends `bounds`; `sight` is the camera's (for "facing").
    void measure(std::vector<LayerPlan>& plans, const Sight& sight, scene::Bounds& bounds);
    void draw(const LayerPlan& plan, std::size_t index, const Sight& sight, Target& target,
              bool show_centres);
    /// The translucent ones among these, once all others are drawn. The id of a pixel is that of the nearest.
    void draw_translucent(const std::vector<LayerPlan>& plans, const Sight& sight, Target& target);
    /// Outlines the selected element, on top of everything.
    void mark(const LayerPlan& plan, std::size_t index, const Sight& sight);

  private:
    gl::Name map_texture(const LayerPlan& plan);
    const gl::Program& begin(const LayerPlan& plan, std::size_t index, const gl::ProgramSource& source);
    void draw_shapes(const LayerPlan& plan, std::size_t index, const Sight& sight);
    void compose(const Target& target);
    void draw_points(const LayerPlan& plan, std::size_t index, const Sight& sight, const Target& target);
    void draw_sphere(const LayerPlan& plan, std::size_t index, const Sight& sight, Target& target,
                     bool show_centres);
    void write_block(const LayerPlan& plan, std::size_t index);
    Tools tools_;
    GLuint vertex_array_ = 0;
    std::vector<std::unique_ptr<DeviceStore>> blocks_;  ///< by layer
    DeviceStore measures_;
    DeviceStore nearest_keys_, nearest_elements_;  ///< of points, see shaders/passes/viewers/points.glsl
    std::map<std::string, gl::Name> maps_;
};

}  // namespace ir::passes::viewers
