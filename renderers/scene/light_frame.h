#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderers/scene/scene.h"

namespace ir::scene {

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
