#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "projects/json.h"

namespace ir::engine {

/// Where variations stand, by their axes: projects::SweepPoint::coordinates.
using Coordinates = std::vector<projects::Json>;

/// Which variations to measure, to tell what all take: first the one with the largest numbers, then those
/// whose values have been measured least. As many as `count`, or all.
std::vector<std::size_t> probes_of(const Coordinates& all, std::size_t count);

/// How many are enough: a few more than a law of the axes has unknowns.
std::size_t enough_probes(const Coordinates& all);

/// What was measured of a variation: seconds, bytes.
using Measurements = std::vector<std::pair<std::size_t, double>>;

/// The sum over all variations. A law that is a constant and a product, of a power of each number and a
/// factor for each word, is fitted to what was measured, which then corrects it in the mean (a ratio
/// estimator [Cochran77 §6]). Nothing measured gives 0.
double predicted_sum(const Coordinates& all, const Measurements& measured);

}  // namespace ir::engine
