#pragma once

// What lib/spaces.glsl and records.glsl say, on the host.

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

namespace ir::methods::ldm_indirect {

/// As LEG_… of records.glsl.
inline constexpr std::uint32_t leg_map = 0xffff, leg_along = 1u << 16, leg_direct = 1u << 17,
                               leg_light_shift = 24;

/// Octahedral in 2 x 16 bits SNORM. [Cigolle14 "oct"]
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

/// (cos φ/2, sin φ/2) for φ = atan2(y, x) in [-π, π], where `size` is the length of (x, y); (1, 0) at 0.
inline glm::vec2 half_angle(float x, float y, float size) {
    if (!(size > 0)) return {1, 0};
    if (x >= 0) {
        const float cosine = std::sqrt(0.5f * (size + x) / size);
        return {cosine, 0.5f * y / (size * cosine)};
    }
    const float sine = std::copysign(std::sqrt(0.5f * (size - x) / size), y);
    return {0.5f * y / (size * sine), sine};
}

}  // namespace ir::methods::ldm_indirect
