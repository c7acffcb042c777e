#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderers/core/constants.h"

namespace ir::passes {

/// Uniform on the unit disk; squares become sectors of rings.  [Shirley97 §2]
inline glm::vec2 concentric_disk(glm::vec2 u) {
    constexpr float quarter = pi / 4;
    const glm::vec2 p = 2.0f * u - 1.0f;
    if (p.x == 0 && p.y == 0) return p;
    const bool wide = std::abs(p.x) > std::abs(p.y);
    const float radius = wide ? p.x : p.y;
    const float angle = wide ? quarter * (p.y / p.x) : quarter * (2 - p.x / p.y);
    return radius * glm::vec2(std::cos(angle), std::sin(angle));
}

}  // namespace ir::passes
