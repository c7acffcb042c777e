#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderers/scene/scene.h"

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

/// The plane of a rectangle or disk light: two unit vectors along Light::size.x and Light::size.y.
struct LightFrame {
    glm::vec3 width{1, 0, 0}, height{0, 0, -1};
};

/// As a camera is held: the width is horizontal, to the right of one who looks along the light's (unit)
/// direction with +Y up. A light that points straight up or down has its width along X and its height along
/// Z. Lights have no other orientation: files that are read know none of rectangles and disks.
inline LightFrame light_frame(const Light& light) {
    constexpr float min_horizontal_part = 1e-4f;
    const glm::vec3 right = glm::cross(light.direction, glm::vec3(0, 1, 0));
    const float length = glm::length(right);
    LightFrame frame;
    if (length > min_horizontal_part) frame.width = right / length;
    frame.height = glm::normalize(glm::cross(frame.width, light.direction));
    return frame;
}

}  // namespace ir::scene
