#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ir::passes {

/// Items chosen with probabilities in proportion to weights of at least 0, by inversion of the cumulative
/// distribution: neighbouring numbers choose neighbouring items. An item of weight 0 is never chosen.
class DiscreteDistribution {
  public:
    struct Choice {
        std::size_t index = 0;
        float probability = 0;
        float rest = 0;  ///< uniform in [0, 1) again, given the index
    };

    DiscreteDistribution() = default;
    /// `weight(i)` for i < n. Without any weight above 0 the distribution is empty.
    template <class Weight>
    DiscreteDistribution(std::size_t n, Weight weight) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += weight(i);
        if (!(sum > 0)) return;
        cumulative_.resize(n + 1);
        double below = 0;
        for (std::size_t i = 0; i < n; ++i) {
            cumulative_[i] = static_cast<float>(std::min(below / sum, 1.0));
            below += weight(i);
        }
        // Rounding must not leave a gap below 1 to an item of weight 0.
        auto last = n;
        while (last > 0 && !(weight(last - 1) > 0)) --last;
        std::fill(cumulative_.begin() + static_cast<std::ptrdiff_t>(last), cumulative_.end(), 1.0f);
    }

    bool empty() const { return cumulative_.empty(); }
    /// One more than there are items; the first is 0. Empty where the distribution is.
    const std::vector<float>& cumulative() const { return cumulative_; }
    float probability(std::size_t index) const { return cumulative_[index + 1] - cumulative_[index]; }

    /// `u` uniform in [0, 1).
    Choice sample(float u) const {
        const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u);
        Choice choice;
        choice.index = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
        choice.probability = probability(choice.index);
        choice.rest = std::clamp((u - cumulative_[choice.index]) / choice.probability, 0.0f, below_one);
        return choice;
    }

  private:
    static constexpr float below_one = 0x1.fffffep-1f;
    std::vector<float> cumulative_;
};

}  // namespace ir::passes
