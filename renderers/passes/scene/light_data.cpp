#include "renderers/passes/scene/light_data.h"

#include <cmath>

namespace ir::passes {
namespace {

using graph::FieldType;

/// Beyond this half-angle (70 degrees) a perspective map would waste most of its texels on the rim.
constexpr float widest_single_map = 1.2217305f;

}  // namespace

std::vector<graph::Field> light_fields() {
    return {{"position_ws", FieldType::f32, 3},  {"type", FieldType::i32},
            {"direction_ws", FieldType::f32, 3}, {"range"},
            {"intensity", FieldType::f32, 3},    {"cos_inner"},
            {"size", FieldType::f32, 2},         {"cos_outer"},
            {"shadow_layer", FieldType::i32},    {"shadow_layers", FieldType::i32},
            {"unused", FieldType::i32, 3}};
}

int shadow_layers(const scene::Light& light) {
    switch (light.type) {
        case scene::LightType::point:
            return 6;
        case scene::LightType::spot:
            return light.outer_angle > widest_single_map ? 6 : 1;
        case scene::LightType::directional:
            return 1;
        default:
            return 0;
    }
}

std::vector<LightData> light_data(const std::vector<scene::Light>& lights) {
    std::vector<LightData> data;
    data.reserve(lights.size());
    int layer = 0;
    for (const auto& light : lights) {
        const int layers = shadow_layers(light);
        data.push_back({light.position,
                        static_cast<int>(light.type),
                        light.direction,
                        light.range,
                        light.colour * light.intensity,
                        std::cos(light.inner_angle),
                        light.size,
                        std::cos(light.outer_angle),
                        layers > 0 ? layer : -1,
                        layers,
                        {0, 0, 0}});
        layer += layers;
    }
    return data;
}

}  // namespace ir::passes
