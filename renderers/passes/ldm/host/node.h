#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "shaders/passes/ldm/fragments.glsl.h"
#include "shaders/passes/ldm/node.glsl.h"

namespace ir::passes::ldm {

/// ldm_slope_codes(): slopes in quanta per texel.
inline std::uint16_t slope_codes(glm::dvec2 slope, double texel_quanta) {
    const auto code = [&](double s) {
        s = std::clamp(s / texel_quanta, -double{ldm_max_kept_slope}, double{ldm_max_kept_slope});
        const double steps = std::nearbyint(double{ldm_slope_steps} * s / (1 + std::abs(s)));
        const double most = double{ldm_max_slope_code};
        return static_cast<unsigned>(static_cast<int>(std::clamp(steps, -most, most))) & 0xffu;
    };
    return static_cast<std::uint16_t>(code(slope.x) | code(slope.y) << 8);
}

/// ldm_slopes() of every code, twice: quanta per two texels.
using SlopeTable = std::array<std::int16_t, 256>;
inline SlopeTable slope_table(float texel_quanta) {
    SlopeTable table;
    for (unsigned code = 0; code < table.size(); ++code) {
        const float s = static_cast<float>(static_cast<std::int8_t>(code)) / ldm_slope_steps;
        // -128 and -127 are no codes.
        const float slope = std::round(s / std::max(1 - std::abs(s), 1e-3f) * texel_quanta);
        table[code] = static_cast<std::int16_t>(2 * std::clamp(slope, -max_slope_quanta, max_slope_quanta));
    }
    return table;
}

/// Whole quanta beyond the key up to which slopes count, of 16 bits. [ldm_lies_before()]
inline int slope_reach_quanta(float texel_quanta) {
    return static_cast<int>(std::min(slope_reach * texel_quanta, ldm_last_depth));
}

/// ldm_slope_tolerance()
inline float slope_tolerance(glm::vec2 slope, glm::vec2 place, float texel_quanta) {
    const auto widening = 1.0f + glm::abs(slope) / texel_quanta;
    return texel_quanta *
           std::min(glm::dot(glm::abs(place), widening * widening) / (2 * ldm_slope_steps), 1.0f);
}

}  // namespace ir::passes::ldm
