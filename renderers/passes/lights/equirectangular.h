#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "renderers/core/constants.h"

namespace ir::passes {

/// Where a direction lies in an equirectangular map, (0, 0) its upper left corner, (1, 1) its lower right
/// one: row 0 is +Y, column 0 is -X, and then come -Z, +X and +Z, so that somebody inside sees the map
/// unmirrored, its centre at +X.
inline glm::vec2 equirectangular_uv(glm::vec3 direction_ws) {
    const float u = std::atan2(-direction_ws.z, -direction_ws.x) / (2 * pi);
    const float horizontal = std::hypot(direction_ws.x, direction_ws.z);  // acos is coarse at the poles
    return {u < 0 ? u + 1 : u, std::atan2(horizontal, direction_ws.y) / pi};
}

/// The unit direction at the horizontal coordinate u with this cosine to +Y.
inline glm::vec3 equirectangular_direction(float u, double cos_theta) {
    const auto sin_theta = static_cast<float>(std::sqrt(std::max(1 - cos_theta * cos_theta, 0.0)));
    const float phi = 2 * pi * u;
    return {-std::cos(phi) * sin_theta, static_cast<float>(cos_theta), -std::sin(phi) * sin_theta};
}

}  // namespace ir::passes
