#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

namespace ir::passes {

/// packed_direction of lib/spaces.glsl: octahedral in 2 x 16 bits SNORM.  [Cigolle14 "oct"]
inline std::uint32_t packed_direction(const glm::vec3& n) {
    const auto sign = [](float v) { return v >= 0 ? 1.0f : -1.0f; };
    const float size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 p(n.x / size, n.y / size);
    if (n.z < 0) p = {(1 - std::abs(p.y)) * sign(p.x), (1 - std::abs(p.x)) * sign(p.y)};
    return glm::packSnorm2x16(p);
}
inline glm::vec3 unpacked_direction(std::uint32_t bits) {
    const auto sign = [](float v) { return v >= 0 ? 1.0f : -1.0f; };
    const auto p = glm::unpackSnorm2x16(bits);
    glm::vec3 v(p, 1 - std::abs(p.x) - std::abs(p.y));
    if (v.z < 0) v = {(1 - std::abs(p.y)) * sign(p.x), (1 - std::abs(p.x)) * sign(p.y), v.z};
    return glm::normalize(v);
}

}  // namespace ir::passes
