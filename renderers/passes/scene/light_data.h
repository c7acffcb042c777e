#pragma once

#include <array>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/scene/scene.h"

namespace ir::passes {

/// A light as struct Light of shaders/lib/light.glsl.
struct LightData {
    glm::vec3 position_ws;
    int type;
    glm::vec3 direction_ws;
    float range;
    glm::vec3 intensity;
    float cos_inner;
    glm::vec2 size;
    float cos_outer;
    int shadow_layer, shadow_layers;
    std::array<int, 3> unused;
    IR_FIELDS(position_ws, type, direction_ws, range, intensity, cos_inner, size, cos_outer, shadow_layer,
              shadow_layers, unused)
};

std::vector<LightData> light_data(const std::vector<scene::Light>& lights);

/// How many layers of "shadow.maps" a light takes: 1 for a directional light and a spot, 6 for a point light
/// and a spot too wide for one perspective map, 0 for lights with extent.
int shadow_layers(const scene::Light& light);

}  // namespace ir::passes
