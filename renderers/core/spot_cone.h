#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ir {

/// Power that a spot sends out per unit of intensity, in sr: the integral of its profile over its cone. The
/// profile is 1 up to the half-angle `inner`, and falls with the square of the cosine's part to 0 at `outer`.
inline double spot_solid_angle(double inner, double outer) {
    const auto between = [](double a, double b) {  // cos a - cos b, also where both are tiny
        return 2 * std::sin((a + b) / 2) * std::sin((b - a) / 2);
    };
    // 2π (∫ from cos inner to 1 of 1 + ∫ from cos outer to cos inner of ((c - cos outer) / width)²) dc
    return 2 * std::numbers::pi * (between(0, inner) + std::max(between(inner, outer), 0.0) / 3);
}

}  // namespace ir
