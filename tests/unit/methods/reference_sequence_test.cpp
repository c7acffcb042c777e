#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "renderers/methods/reference/estimate.h"
#include "renderers/methods/reference/visibility.h"
#include "renderers/passes/sampling/point_sequence.h"

namespace ir::methods::reference {
namespace {

using passes::mixed;
using passes::PathSampler;
using passes::pixel_key;
using passes::PointSequence;

/// Largest number of the first 2^k points of a sequence in one of the 2^a × 2^(k-a) equal boxes.
template <class Sequence>
int max_in_a_box(const Sequence& sequence, int k, int a) {
    std::vector<int> boxes(std::size_t{1} << k);
    for (std::uint32_t i = 0; i < 1u << k; ++i) {
        const auto p = sequence.point(i);
        const auto x = static_cast<int>(p.x * static_cast<float>(1 << a));
        const auto y = static_cast<int>(p.y * static_cast<float>(1 << (k - a)));
        ++boxes[static_cast<std::size_t>(y << a | x)];
    }
    return *std::max_element(boxes.begin(), boxes.end());
}

TEST(PointSequence, PutsOnePointIntoEachElementaryInterval) {
    for (std::uint64_t key = 0; key < 20; ++key) {
        const PointSequence sequence(key);
        for (int k = 0; k <= 10; ++k) {
            for (int a = 0; a <= k; ++a) EXPECT_EQ(max_in_a_box(sequence, k, a), 1) << k << " " << a;
        }
    }
}

struct Independent {
    glm::vec2 point(std::uint32_t i) const {
        const auto bits = mixed(i);
        return {static_cast<float>(bits & 0xffffff) * 0x1p-24f, static_cast<float>(bits >> 40) * 0x1p-24f};
    }
};

TEST(PointSequence, StratificationTestRejectsIndependentPoints) {
    EXPECT_GT(max_in_a_box(Independent(), 8, 4), 1);
}

/// χ² of n points over 8 × 8 equal boxes; 63 degrees of freedom.
constexpr double chi2_63_at_1e_4 = 114;
template <class Point>
double chi2_of(int n, Point point) {
    std::array<int, 64> boxes{};
    for (int i = 0; i < n; ++i) {
        const glm::vec2 p = point(i);
        ++boxes.at(static_cast<std::size_t>(p.y * 8) * 8 + static_cast<std::size_t>(p.x * 8));
    }
    double sum = 0;
    for (const int count : boxes) sum += (count - n / 64.0) * (count - n / 64.0) / (n / 64.0);
    return sum;
}

TEST(PointSequence, EveryPointIsUniformOverTheKeys) {
    // n = 65,536 keys, 64 bins, α = 1e-4 for each of five points.
    for (const std::uint32_t index : {0u, 1u, 2u, 77u, 123456u}) {
        const auto chi2 = chi2_of(1 << 16, [&](int i) { return PointSequence(mixed(i)).point(index); });
        EXPECT_LT(chi2, chi2_63_at_1e_4) << "point " << index;
    }
}

TEST(PointSequence, UniformityTestRejectsOneScrambleForBothDimensions) {
    // Mutant: the same random number in x and y.
    const auto chi2 = chi2_of(1 << 16, [](int i) { return glm::vec2(PointSequence(mixed(i)).point(0).x); });
    EXPECT_GT(chi2, chi2_63_at_1e_4);
}

TEST(PointSequence, PixelsAndRandomisationsAreUnrelated) {
    // Pairs (x of pixel p, x of its neighbour) and (x of one randomisation, x of the next) fill the square.
    const auto x_at = [](std::uint32_t pixel, std::uint64_t sample) {
        return PixelSamples(3, pixel % 256, pixel / 256).point(sample).x;
    };
    const auto neighbours = [&](int i) { return glm::vec2(x_at(2 * i, 0), x_at(2 * i + 1, 0)); };
    const auto randomised = [&](int i) { return glm::vec2(x_at(i, 0), x_at(i, 1)); };
    EXPECT_LT(chi2_of(1 << 15, neighbours), chi2_63_at_1e_4);
    EXPECT_LT(chi2_of(1 << 15, randomised), chi2_63_at_1e_4);
}

TEST(CosineDirection, HasTheDensityOfTheCosine) {
    // cos²θ and φ are then uniform and independent. n = 65,536, 64 bins, α = 1e-4.
    const auto square = [](glm::vec3 direction) {
        const float phi = std::atan2(direction.y, direction.x) / 6.2831855f;
        return glm::vec2(std::min(direction.z * direction.z, 0.9999999f),
                         std::clamp(phi < 0 ? phi + 1 : phi, 0.0f, 0.9999999f));
    };
    const auto cosine = [&](int i) {
        return square(cosine_direction(Independent().point(static_cast<std::uint32_t>(i)), {0, 0, 1}));
    };
    EXPECT_LT(chi2_of(1 << 16, cosine), chi2_63_at_1e_4);
    // Mutant: uniform in solid angle, cosθ = u.
    const auto uniform = [&](int i) {
        const auto u = Independent().point(static_cast<std::uint32_t>(i));
        const float r = std::sqrt(1 - u.x * u.x), phi = 6.2831855f * u.y;
        return square({r * std::cos(phi), r * std::sin(phi), u.x});
    };
    EXPECT_GT(chi2_of(1 << 16, uniform), chi2_63_at_1e_4);
}

TEST(CosineDirection, TurnsWithTheNormal) {
    for (const glm::vec3 axis : {glm::vec3(0, 0, 1), {0, 0, -1}, {0, 1, 0}, {-1, 2, -3}, {1e-4f, 0, -1}}) {
        const auto n = glm::normalize(axis);
        for (int i = 0; i < 100; ++i) {
            const auto u = Independent().point(static_cast<std::uint32_t>(i));
            const auto direction = cosine_direction(u, n);
            EXPECT_NEAR(glm::length(direction), 1, 1e-6);
            EXPECT_NEAR(glm::dot(direction, n), std::sqrt(1 - u.x), 2e-6);
        }
    }
}

/// The points of a pixel's paths in one dimension and randomisation.
struct PathDimension {
    std::uint64_t key;
    std::uint32_t dimension;
    glm::vec2 point(std::uint32_t i) const { return PathSampler(key, i).pair(dimension); }
};

TEST(PathSampler, PutsOnePointIntoEachElementaryInterval) {
    // Shuffled within blocks whose lengths are powers of two: the first 2^k points stay a net.
    for (const std::uint32_t dimension : {0u, 1u, 17u}) {
        for (int k = 0; k <= 8; ++k) {
            for (int a = 0; a <= k; ++a)
                EXPECT_EQ(max_in_a_box(PathDimension{77, dimension}, k, a), 1) << k << " " << a;
        }
    }
}

TEST(PathSampler, DimensionsAreUnrelated) {
    // Pairs (x of one dimension, x of another) of 65,536 paths, each the first of its key: 64 bins, α = 1e-4.
    for (const auto& [one, other] : {std::pair{0u, 1u}, {1u, 2u}, {3u, 40u}}) {
        const auto chi2 = chi2_of(1 << 16, [&, one = one, other = other](int i) {
            const PathSampler path(mixed(i), 5);
            return glm::vec2(path.pair(one).x, path.pair(other).x);
        });
        EXPECT_LT(chi2, chi2_63_at_1e_4) << one << " " << other;
    }
}

TEST(PathSampler, DimensionsAreShuffledApart) {
    // Of one key: with 4096 points of two dimensions, all boxes of a coarse grid are filled about equally.
    // Without shuffling they lie on few lines: the test rejects one dimension taken twice.
    const auto pairs = [](std::uint32_t other) {
        return chi2_of(4096, [=](int i) {
            const PathSampler path(9, static_cast<std::uint32_t>(i));
            return glm::vec2(path.pair(2).x, path.pair(other).x);
        });
    };
    EXPECT_LT(pairs(3), chi2_63_at_1e_4);
    EXPECT_GT(pairs(2), chi2_63_at_1e_4);
}

TEST(Estimate, IsTheMeanOfAllSamples) {
    EXPECT_DOUBLE_EQ(estimate({3, 1, 2, 0, 0, 0, 0, 2}, 16, 0.25).mean, 0.5);
    EXPECT_DOUBLE_EQ(estimate({1, 0, 1, 0, 0, 0, 0, 0}, 3, 0.25).mean, 2.0 / 3);
}

TEST(Estimate, TakesTheVarianceFromTheRandomisations) {
    // Means 0.5 ± 0.5 in eight randomisations: sample variance 8/7 · 1/4, of the mean 1/28.
    EXPECT_NEAR(estimate({4, 0, 4, 0, 4, 0, 4, 0}, 32, 0.25).variance, 1.0 / 28, 1e-15);
    EXPECT_EQ(estimate({2, 2, 2, 2, 2, 2, 2, 2}, 16, 0.25).variance, 0);
    // Fewer samples than randomisations: independent samples. 1, 0, 1 has the variance 1/3, its mean 1/9.
    EXPECT_NEAR(estimate({1, 0, 1, 0, 0, 0, 0, 0}, 3, 0.25).variance, 1.0 / 9, 1e-15);
    EXPECT_EQ(estimate({1, 0, 0, 0, 0, 0, 0, 0}, 1, 0.7).variance, 0.7);  // one sample says nothing
    // Shares that differ do not look like variance.
    EXPECT_NEAR(estimate({2, 2, 1, 1, 1, 1, 1, 1}, 10, 0.25).variance, 0, 1e-15);
}

TEST(Visibility, FollowsItsRule) {
    constexpr float never = std::numeric_limits<float>::infinity();
    const VisibilityRule unlimited{}, hard{2, Transport::Falloff::hard},
        smooth{2, Transport::Falloff::smooth};
    EXPECT_EQ(visibility(unlimited, 1e6f), 0);
    EXPECT_EQ(visibility(unlimited, never), 1);
    EXPECT_EQ(visibility(hard, 1.99f), 0);
    EXPECT_EQ(visibility(hard, 2.01f), 1);
    EXPECT_EQ(visibility(smooth, 0), 0);
    EXPECT_FLOAT_EQ(visibility(smooth, 1), 0.25f);
    EXPECT_EQ(visibility(smooth, 2.01f), 1);
    EXPECT_EQ(visibility({0, Transport::Falloff::smooth}, 5), 0);
}

}  // namespace
}  // namespace ir::methods::reference
