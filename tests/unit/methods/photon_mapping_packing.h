#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "renderers/methods/photon-mapping/unpacked.h"

/// How photons are packed (shaders/methods/photon-mapping/records.glsl), on the host.
namespace ir::methods::photon_mapping {

/// Of RGB9E5.  [OpenGL 4.5 §8.25]
inline constexpr int mantissa_bits = 9, exponent_bias = 15;
inline constexpr float largest_power = 65408;
inline constexpr std::uint32_t mantissa_mask = (1u << mantissa_bits) - 1;

inline float representable(float power) {
    return power > 0 ? std::min(power, largest_power) : 0.0f;  // NaN is not above 0
}

/// In units of 2^(shared_exponent - 24).
inline std::uint32_t mantissa(float power, int shared_exponent) {
    const float scaled = std::ldexp(power, mantissa_bits + exponent_bias - shared_exponent);
    return static_cast<std::uint32_t>(std::nearbyint(scaled));
}

/// RGB9E5: shared 5-bit exponent, three 9-bit mantissas, rounded to nearest; negative and NaN give 0, larger
/// than 65408 that.  [OpenGL 4.5 §8.25, EXT_texture_shared_exponent]
inline std::uint32_t packed_power(glm::vec3 power) {
    const glm::vec3 c(representable(power.r), representable(power.g), representable(power.b));
    const float largest = std::max({c.r, c.g, c.b});
    if (largest <= 0) return 0;
    int exponent = 0;
    std::frexp(largest, &exponent);  // largest = m 2^exponent, m in [1/2, 1)
    int shared_exponent = std::max(-exponent_bias - 1, exponent - 1) + exponent_bias + 1;
    if (mantissa(largest, shared_exponent) > mantissa_mask) ++shared_exponent;
    return mantissa(c.r, shared_exponent) | mantissa(c.g, shared_exponent) << mantissa_bits |
           mantissa(c.b, shared_exponent) << 2 * mantissa_bits |
           static_cast<std::uint32_t>(shared_exponent) << 3 * mantissa_bits;
}

/// The two words and the sign bit of a photon's directions.
struct StereographicDirection {
    std::uint32_t xy;
    bool below;  ///< z < 0
};
inline StereographicDirection packed_stereographic(glm::vec3 unit) {
    return {glm::packHalf2x16(glm::vec2(unit) / (1 + std::abs(unit.z))), unit.z < 0};
}

}  // namespace ir::methods::photon_mapping
