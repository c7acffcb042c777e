#pragma once

#include <glm/glm.hpp>

namespace ir::passes {

/// As shaders/lib/pattern_shift.glsl: Bayer's matrix, read in three ways.
inline glm::vec3 pattern_shift(glm::ivec2 pixel) {
    constexpr int bayer[16] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    const auto p = pixel & 3;
    const glm::ivec3 place(4 * p.y + p.x, 4 * ((p.x + 1) & 3) + p.y,
                           4 * ((p.y + p.x + 2) & 3) + ((p.x + 3) & 3));
    return (glm::vec3(bayer[place.x], bayer[place.y], bayer[place.z]) + 0.5f) / 16.0f;
}

}  // namespace ir::passes
