#include "renderers/passes/lights/punctual.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderers/core/spot_cone.h"

namespace ir::passes {

float spot_profile(float cosine, float cos_inner, float cos_outer) {
    constexpr float hard_edge = 1e-6f;  // as in the shader
    const float width = cos_inner - cos_outer;
    if (width < hard_edge) return cosine >= cos_outer ? 1.0f : 0.0f;
    const float fraction = std::clamp((cosine - cos_outer) / width, 0.0f, 1.0f);
    return fraction * fraction;
}

float range_window(float range, float distance) {
    if (range <= 0) return 1;
    const float ratio = distance / range;
    return std::clamp(1 - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
}

std::optional<PunctualArrival> punctual_arrival(const scene::Light& light, glm::vec3 position_ws) {
    const glm::vec3 intensity = light.colour * light.intensity;
    if (light.type == scene::LightType::directional)
        return PunctualArrival{-light.direction, std::numeric_limits<float>::infinity(), intensity};
    const glm::vec3 offset = light.position - position_ws;
    const float squared = glm::dot(offset, offset);
    if (!(squared > 0)) return std::nullopt;
    const float distance = std::sqrt(squared);
    const glm::vec3 direction_ws = offset / distance;
    float part = range_window(light.range, distance) / squared;
    if (light.type == scene::LightType::spot)
        part *= spot_profile(-glm::dot(direction_ws, light.direction), std::cos(light.inner_angle),
                             std::cos(light.outer_angle));
    if (!(part > 0)) return std::nullopt;
    return PunctualArrival{direction_ws, distance, part * intensity};
}

float punctual_solid_angle(const scene::Light& light) {
    if (light.type != scene::LightType::spot) return 4 * std::numbers::pi_v<float>;
    return static_cast<float>(spot_solid_angle(light.inner_angle, light.outer_angle));
}

}  // namespace ir::passes
