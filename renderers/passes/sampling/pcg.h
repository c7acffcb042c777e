#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace ir::passes {

/// As shaders/lib/random.glsl, whose names these are: hashes, and numbers in [0, 1). [Jarzynski20]
inline std::uint32_t pcg(std::uint32_t v) {
    const std::uint32_t state = v * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

inline glm::uvec2 pcg2d(glm::uvec2 v) {
    v = v * 1664525u + 1013904223u;
    for (int round = 0; round < 2; ++round) {
        v.x += v.y * 1664525u;
        v.y += v.x * 1664525u;
        v ^= v >> 16u;
    }
    return v;
}

inline glm::uvec3 pcg3d(glm::uvec3 v) {
    v = v * 1664525u + 1013904223u;
    const auto mix = [&] {
        v.x += v.y * v.z;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
    };
    mix();
    v ^= v >> 16u;
    mix();
    return v;
}

inline glm::uvec4 pcg4d(glm::uvec4 v) {
    v = v * 1664525u + 1013904223u;
    const auto mix = [&] {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
    };
    mix();
    v ^= v >> 16u;
    mix();
    return v;
}

inline float unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace ir::passes
