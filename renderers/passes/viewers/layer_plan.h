#pragma once

#include <cstdint>
#include <vector>

#include "renderers/graph/graph.h"
#include "renderers/passes/viewers/scene_3d.h"
#include "shaders/passes/viewers/layer.glsl.h"

namespace ir::passes::viewers {

/// A layer made ready: where its numbers stand, or why it cannot be drawn.
struct LayerPlan {
    Layer wanted;
    DrawnLayer drawn;
    bool drawable = false;
    bool has_own_space = false;  ///< stands apart from the scene
    Primitive primitive = Primitive::points;
    float opacity = 1;
    FieldType colour_type = FieldType::f32;
    std::vector<Category> categories;  ///< of the field that colours, where its numbers are names
    LayerBlock block{.step = 1,
                     .place = {-1, -1, -1, -1},
                     .normal = -1,
                     .colatitude = -1,
                     .longitude = -1,
                     .colour_offset = -1,
                     .high = 1};
    gl::Name buffer = 0;
    bool is_translucent() const { return drawable && opacity < 1; }
};

/// What a layer is and where its fields stand. `buffer` is absent where the graph has no such contents;
/// `index` is the layer's place in the view.
LayerPlan plan_layer(const Layer& layer, const std::optional<graph::DeviceBuffer>& buffer, std::size_t index,
                     std::uint64_t max_elements, std::uint64_t max_buffer_bytes);

/// Beside layers of the scene those with a space of their own are not drawn, and say so.
void keep_spaces_apart(std::vector<LayerPlan>& plans);

}  // namespace ir::passes::viewers
