#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderers/graph/graph.h"
#include "renderers/passes/viewers/scene_3d.h"

namespace ir::passes::viewers {

enum class Primitive { points, lines, discs, parallelograms, ellipsoids, sphere };

/// As struct Filter of shaders/passes/viewers/layer.glsl; the range is in the bits of the field's own type.
struct FilterBlock {
    std::int32_t offset = 0, type = 0;
    std::uint32_t low = 0, high = 0;
};

/// What colours an element.
enum class ColourMode : std::int32_t { single, field, facing };

/// As block LayerBlock of shaders/passes/viewers/layer.glsl. Offsets are in words of four bytes within an
/// element; -1: absent.
struct LayerBlock {
    static constexpr std::size_t max_filters = 8;
    std::uint32_t words = 0;   ///< of an element
    std::uint32_t step = 1;    ///< every n-th element is drawn
    std::uint32_t drawn = 0;   ///< so many then
    std::uint32_t number = 0;  ///< index of the layer plus 1, as in the picture of ids
    std::array<std::int32_t, 4> place{-1, -1, -1, -1};  ///< what it needs, in the order of scene_3d.h
    std::int32_t normal = -1;
    std::int32_t colatitude = -1, longitude = -1;
    std::int32_t colour_offset = -1, colour_type = 0;
    ColourMode colour_mode = ColourMode::single;
    float low = 0, high = 1;  ///< of the colour map
    float size_px = 3;
    float red = 0, green = 0, blue = 0;  ///< linear; of a layer in one colour
    std::int32_t primitive = 0;
    std::int32_t filter_count = 0;
    std::array<FilterBlock, max_filters> filters{};
};

/// A layer made ready: where its numbers stand, or why it cannot be drawn.
struct LayerPlan {
    Layer wanted;
    DrawnLayer drawn;
    bool drawable = false;
    bool has_own_space = false;  ///< stands apart from the scene
    Primitive primitive = Primitive::points;
    FieldType colour_type = FieldType::f32;
    std::vector<Category> categories;  ///< of the field that colours, where its numbers are names
    LayerBlock block;
    gl::Name buffer = 0;
};

/// What a layer is and where its fields stand. `buffer` is absent where the graph has no such contents;
/// `index` is the layer's place in the view.
LayerPlan plan_layer(const Layer& layer, const std::optional<graph::DeviceBuffer>& buffer, std::size_t index,
                     std::uint64_t max_elements, std::uint64_t max_buffer_bytes);

/// Beside layers of the scene those with a space of their own are not drawn, and say so.
void keep_spaces_apart(std::vector<LayerPlan>& plans);

}  // namespace ir::passes::viewers
