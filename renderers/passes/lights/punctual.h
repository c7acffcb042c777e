#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderers/scene/scene.h"

namespace ir::passes {

/// Without extent: no ray can meet it.
inline bool is_punctual(const scene::Light& light) {
    return light.type == scene::LightType::point || light.type == scene::LightType::spot ||
           light.type == scene::LightType::directional;
}

/// What arrives of a light without extent, nothing in between.
struct PunctualArrival {
    glm::vec3 direction_ws{0};  ///< to the light, unit length
    float distance = 0;         ///< m; infinite for directional lights
    glm::vec3 irradiance{0};    ///< W/m² on a surface that faces the light
};

/// Point, spot or directional light, by the same formulas as shaders/lib/light.glsl. Nothing at the light's
/// own position, outside a spot's cone and beyond the range.
std::optional<PunctualArrival> punctual_arrival(const scene::Light& light, glm::vec3 position_ws);

/// Fraction of a spot's intensity at an angle to its axis with this cosine: squared linear between the cones,
/// a hard edge where they coincide.  [glTF2 KHR_lights_punctual, inner and outer cone angles]
float spot_profile(float cosine, float cos_inner, float cos_outer);

/// The recommended window that takes a light to 0 at its range; 1 where the range is 0 (unlimited).
/// [glTF2 KHR_lights_punctual, range property]
float range_window(float range, float distance);

/// Power that a point or spot light sends out per unit of intensity, in sr: ∫ profile dω.
float punctual_solid_angle(const scene::Light& light);

}  // namespace ir::passes
