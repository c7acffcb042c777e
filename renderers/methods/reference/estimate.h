#pragma once

#include <array>
#include <cstdint>

namespace ir::methods::reference {

/// A pixel's samples are dealt in turn to this many independent randomisations of one low-discrepancy
/// sequence. Within a randomisation samples are not independent, so the variance of the mean is estimated
/// from the differences between randomisations: unbiased, with one degree of freedom fewer than there are of
/// them. The price is that each has only its share of the points.
constexpr int randomisations = 8;

/// Sum of the samples in each randomisation. Sample i belongs to randomisation i mod 8, as its point i / 8.
using Sums = std::array<float, randomisations>;

struct Estimate {
    double mean = 0;
    double variance = 0;  ///< of the mean
};

/// Of a quantity within [0, 1]; `samples` > 0. Multiples of 8 (and fewer than 8) give an unbiased variance,
/// others one that is off by a fraction of 8 / samples. A single sample says nothing about its variance: the
/// largest possible one, 1/4, is given.
Estimate estimate(const Sums& sums, std::uint64_t samples);

}  // namespace ir::methods::reference
