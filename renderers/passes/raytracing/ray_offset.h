#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace ir::passes {

/// Smallest and relative distance by which rays start away from their surface. The relative part is 32 units
/// in the last place (2⁻²³ each) of the largest coordinate: rasterised positions of Sponza were measured 1 to
/// 4 units off their triangle's plane (99 %), seldom 7, and the traversal adds a few of its own.
constexpr float min_ray_offset_m = 1e-6f;
constexpr float relative_ray_offset = 32 * 0x1p-23f;

/// Shadow rays end this fraction before the point on the light, so that they do not meet it.
constexpr float shadow_ray_end = 1 - 1e-4f;

/// How far a ray's origin must be moved so that the ray does not meet the surface that it starts on, in
/// metres at `position_ws`: 4 µm near 1 m, 4 mm near 1 km. After [Waechter19], with a length in place of
/// steps in the integer representation, so that all components move along the normal.
inline float ray_offset(glm::vec3 position_ws) {
    const auto size = glm::abs(position_ws);
    return min_ray_offset_m + relative_ray_offset * std::max({size.x, size.y, size.z});
}

/// Origin of rays that leave the side to which the unit geometric normal points.
inline glm::vec3 offset_origin(glm::vec3 position_ws, glm::vec3 geometric_normal_ws) {
    return position_ws + ray_offset(position_ws) * geometric_normal_ws;
}

}  // namespace ir::passes
