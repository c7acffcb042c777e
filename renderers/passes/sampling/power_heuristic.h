#pragma once

namespace ir::passes {

/// Weight of a sample that was drawn with density `pdf` where another technique has the density `other`.
/// [Veach95, power heuristic with β = 2]
inline float power_heuristic(float pdf, float other) {
    const float ratio = other / pdf;
    return 1 / (1 + ratio * ratio);
}

}  // namespace ir::passes
