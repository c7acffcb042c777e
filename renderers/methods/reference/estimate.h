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
/// Samples are added one by one in order, in single precision: the sums are then the same bits however the
/// samples were dealt to frames and sessions. After 10⁶ samples rounding has made a relative error of about
/// 10⁻⁵, far below that of the samples themselves.
using Sums = std::array<float, randomisations>;

struct Estimate {
    double mean = 0;
    double variance = 0;  ///< of the mean
};

/// `samples` > 0. Multiples of 8 (and fewer than 8) give an unbiased variance, others one that is off by a
/// fraction of 8 / samples. A single sample says nothing about its variance: it is taken to be `unknown`.
Estimate estimate(const Sums& sums, std::uint64_t samples, double unknown);

/// The largest variance that a quantity within [0, 1] can have.
constexpr double largest_variance_of_a_fraction = 0.25;

}  // namespace ir::methods::reference
