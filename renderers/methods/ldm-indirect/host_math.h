#pragma once

// What lib/spaces.glsl says, on the host.

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "renderers/passes/surface/octahedral.h"
#include "shaders/methods/ldm-indirect/records.glsl.h"

namespace ir::methods::ldm_indirect {

using passes::packed_direction;
using passes::unpacked_direction;

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

/// Of a photon's kernel.
template <class Photon>
float part_on_surface(const Photon& photon) {
    return 1 - static_cast<float>(photon.leg >> leg_beyond_shift & leg_beyond) / 64;
}

}  // namespace ir::methods::ldm_indirect
