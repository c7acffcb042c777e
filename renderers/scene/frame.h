#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace ir::scene {

/// A unit vector perpendicular to a unit normal [Duff17 "Building an Orthonormal Basis, Revisited"].
inline glm::vec3 any_tangent(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

/// Columns: tangent, bitangent, n.
inline glm::mat3 frame_around(glm::vec3 n) {
    const auto tangent = any_tangent(n);
    return {tangent, glm::cross(n, tangent), n};
}

}  // namespace ir::scene
