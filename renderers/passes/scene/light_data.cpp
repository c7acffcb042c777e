#include "renderers/passes/scene/light_data.h"

#include <cmath>

namespace ir::passes {
namespace {

/// Beyond this half-angle (70 degrees) a perspective map would waste most of its texels on the rim.
constexpr float widest_single_map = 1.2217305f;

}  // namespace

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
