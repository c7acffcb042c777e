#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderers/core/record.h"

namespace ir::methods::photon_mapping {

/// A cell of "emission.histogram": expected and found numbers of points. The last element is the sum, with x
/// and y -1, χ² of all and its degrees of freedom.
struct HistogramCell {
    std::int32_t x, y;
    float expected, found;
    float chi_square;  ///< the cell's (found - expected)² / expected; 0 where nothing is expected
    std::int32_t degrees;
    IR_FIELDS(x, y, expected, found, chi_square, degrees)
};

/// Cells a side.
inline constexpr int histogram_cells = 16;

struct ChiSquare {
    float sum;
    std::int32_t degrees;
};
/// Of how many points came to each cell, `found`, against what the cells' `weights` expect of all of them.
/// Neighbouring cells that expect fewer than 5 points are pooled; what comes to where nothing is expected
/// makes it infinite, but for an empty map, which expects nothing anywhere.
ChiSquare chi_square(std::span<const double> weights, std::span<const double> found);

/// `map`: the weights that points should follow, square, row 0 first; `texels`: x + resolution · y of each
/// point.
std::vector<HistogramCell> histogram(std::span<const float> map, int resolution,
                                     std::span<const std::uint32_t> texels);

}  // namespace ir::methods::photon_mapping
