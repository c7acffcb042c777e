#include "renderers/methods/reference/estimate.h"

#include <algorithm>

namespace ir::methods::reference {

Estimate estimate(const Sums& sums, std::uint64_t samples, double unknown) {
    const auto n = static_cast<double>(samples);
    double total = 0;
    for (const auto sum : sums) total += sum;
    Estimate result{total / n, unknown};
    const auto used = std::min<std::uint64_t>(samples, randomisations);
    if (used < 2) return result;
    double squares = 0;
    for (std::uint64_t r = 0; r < used; ++r) {
        const auto share = static_cast<double>(samples / randomisations + (r < samples % randomisations));
        const double difference = sums[r] - share * result.mean;
        squares += difference * difference;
    }
    const auto k = static_cast<double>(used);
    result.variance = squares * k / (k - 1) / (n * n);
    return result;
}

}  // namespace ir::methods::reference
