#pragma once

#include <cstdint>
#include <vector>

namespace ir::engine {

/// How far a picture whose samples add up has come.
struct ConvergencePoint {
    std::uint64_t samples = 0;
    double ms = 0;             ///< from the beginning
    double squared_error = 0;  ///< mean of the squared differences from the truth
};

/// Milliseconds until the squared error has fallen to `squared_error`. Between the points, which have growing
/// numbers of samples, the logarithm of the error is linear in that of the samples, and the time in the
/// samples; beyond the last the squared error is as 1 / samples. What is reached by the first point takes as
/// long as that. Infinite for an error of 0 or less. Needs two points.
double ms_to_error(const std::vector<ConvergencePoint>& points, double squared_error);

}  // namespace ir::engine
