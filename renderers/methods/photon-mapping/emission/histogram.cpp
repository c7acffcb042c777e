#include "renderers/methods/photon-mapping/emission/histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ir::methods::photon_mapping {
namespace {

/// Below, χ² is not approximated by its distribution.  [Cochran54]
constexpr double min_expected = 5;

/// The sum as it grows.
struct Pools {
    double sum = 0, expected = 0, found = 0;  ///< of the pool that is open
    int bins = 0;

    void add(double more_expected, double more_found) {
        expected += more_expected;
        found += more_found;
        if (expected >= min_expected) close();
    }
    void close() {
        if (expected > 0) {
            sum += (found - expected) * (found - expected) / expected;
            ++bins;
        } else if (found > 0) {
            sum = std::numeric_limits<double>::infinity();
        }
        expected = found = 0;
    }
};

}  // namespace

ChiSquare chi_square(std::span<const double> weights, std::span<const double> found) {
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    const double points = std::accumulate(found.begin(), found.end(), 0.0);
    if (!(all > 0)) return {0, 0};
    Pools pools;
    for (std::size_t i = 0; i < weights.size(); ++i) pools.add(points * weights[i] / all, found[i]);
    pools.close();
    return {static_cast<float>(pools.sum), std::max(0, pools.bins - 1)};
}

std::vector<HistogramCell> histogram(std::span<const float> map, int resolution,
                                     std::span<const std::uint32_t> texels) {
    std::vector<double> weights(histogram_cells * histogram_cells), counts(weights.size());
    const auto cell_of = [&](std::size_t texel) {
        const auto side = static_cast<std::size_t>(resolution);
        return texel / side * histogram_cells / side * histogram_cells +
               texel % side * histogram_cells / side;
    };
    double sum = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        weights[cell_of(i)] += map[i];
        sum += map[i];
    }
    for (const auto texel : texels) ++counts[cell_of(texel)];

    std::vector<HistogramCell> cells;
    const auto points = static_cast<double>(texels.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double expected = sum > 0 ? points * weights[i] / sum : 0, found = counts[i];
        const double difference = found - expected;
        cells.push_back({static_cast<std::int32_t>(i % histogram_cells),
                         static_cast<std::int32_t>(i / histogram_cells), static_cast<float>(expected),
                         static_cast<float>(found),
                         expected > 0 ? static_cast<float>(difference * difference / expected) : 0, 0});
    }
    const auto fit = chi_square(weights, counts);
    cells.push_back(
        {-1, -1, static_cast<float>(sum > 0 ? points : 0), static_cast<float>(points), fit.sum, fit.degrees});
    return cells;
}

}  // namespace ir::methods::photon_mapping
