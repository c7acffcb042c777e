#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/constants.h"

namespace ir::scene::builtin {

/// The same numbers on every platform, unlike the distributions of <random>. Output function: PCG-RXS-M-XS
/// [O'Neill 2014].
class Random {
  public:
    explicit Random(std::uint32_t seed) : state_(seed * 2654435761u + 1013904223u) {}
    std::uint32_t bits() {
        state_ = state_ * 747796405u + 2891336453u;
        const std::uint32_t word = ((state_ >> ((state_ >> 28) + 4)) ^ state_) * 277803737u;
        return (word >> 22) ^ word;
    }
    /// In [0, 1).
    float unit() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    /// Anywhere on the unit sphere.
    glm::vec3 direction() {
        const float z = between(-1, 1), angle = between(0, 2 * pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), z, r * std::sin(angle)};
    }

  private:
    std::uint32_t state_;
};

}  // namespace ir::scene::builtin
