#pragma once

// What records.glsl says of packed numbers, on the host.

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {

/// RGB9E5: 9 bits a mantissa, 5 of the exponent.  [OpenGL 4.5 §8.25]
inline glm::vec3 unpacked_power(std::uint32_t bits) {
    const glm::vec3 mantissa(static_cast<float>(bits & 511u), static_cast<float>(bits >> 9 & 511u),
                             static_cast<float>(bits >> 18 & 511u));
    return std::ldexp(1.0f, static_cast<int>(bits >> 27) - 24) * mantissa;
}

inline glm::vec3 unpacked_stereographic(std::uint32_t xy, bool below) {
    const auto p = glm::unpackHalf2x16(xy);
    const float d = glm::dot(p, p);
    return glm::vec3(2.0f * p, below ? d - 1 : 1 - d) / (1 + d);
}

inline glm::vec3 normal_of(const Photon& photon) {
    return unpacked_stereographic(photon.normal, (photon.bits & 1u) != 0);
}
/// Towards where it came from.
inline glm::vec3 direction_of(const Photon& photon) {
    return unpacked_stereographic(photon.direction, (photon.bits & 2u) != 0);
}

}  // namespace ir::methods::photon_mapping
