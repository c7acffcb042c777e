#pragma once

#include <array>
#include <cstdint>

#include "renderers/passes/vectors/lanes.h"

namespace ir::passes {

/// Seeds of points of Sobol's sequence, and which of it each is.
struct PointSeeds {
    using Plane = std::array<std::uint32_t, lane_count>;
    alignas(64) Plane index{}, order{}, x{}, y{};
};

/// What PathSampler::pair() does with its seeds, for all lanes.
void scramble_points(const PointSeeds& seeds, Lanes2& points);

}  // namespace ir::passes
