// Significance: a difference is shown where noise does not explain it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "renderers/core/error.h"
#include "renderers/image/difference.h"
#include "renderers/image/noise.h"

namespace ir {
namespace {

constexpr int side = 128, randomisations = 8;

struct Measured {
    Image mean, variance;
};

/// Means of 8 Gaussian numbers, and the variances of these means as estimated from the same numbers.
template <class Deviation>
Measured measure(unsigned seed, Deviation deviation) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    Measured result{Image(side, side, 1), Image(side, side, 1)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            double sum = 0, squares = 0;
            for (int i = 0; i < randomisations; ++i) {
                const double value = deviation(x, y) * normal(engine);
                sum += value;
                squares += value * value;
            }
            const double mean = sum / randomisations;
            result.mean.at(x, y) = float(1 + mean);
            result.variance.at(x, y) = float((squares / randomisations - mean * mean) / (randomisations - 1));
        }
    return result;
}

std::size_t count_nonzero(const Image& image) {
    std::size_t count = 0;
    for (const float value : image.pixels) count += value != 0;
    return count;
}

Image significant(const Measured& a, const Measured& b, double alpha) {
    return difference(a.mean, b.mean, DifferenceKind::significant,
                      {.variance_a = &a.variance, .variance_b = &b.variance, .alpha = alpha}, nullptr,
                      nullptr)
        .image;
}

/// |a - b| against the normal quantile and each pixel's own variance: what one writes without thinking.
std::size_t naive(const Measured& a, const Measured& b, double quantile) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.mean.pixels.size(); ++i)
        count += std::abs(a.mean.pixels[i] - b.mean.pixels[i]) >
                 quantile * std::sqrt(a.variance.pixels[i] + b.variance.pixels[i]);
    return count;
}

// n = 4 · 128² = 65536 pixels without a difference, probability 1e-3 a pixel: 65.5 are expected at most. That
// more than twice as many show has a probability below 1e-12 (normal approximation, 8 standard deviations),
// far below α = 1e-4. Mutant: the normal quantile without pooling.
TEST(Significance, NoiseAloneIsRarelySignificant) {
    constexpr double alpha = 1e-3, normal_quantile = 3.2905;
    const auto even = [](int, int) { return 0.1; };
    std::size_t found = 0, mutant = 0;
    for (unsigned trial = 0; trial < 4; ++trial) {
        const auto a = measure(2 * trial + 1, even), b = measure(2 * trial + 2, even);
        found += count_nonzero(significant(a, b, alpha));
        mutant += naive(a, b, normal_quantile);
    }
    constexpr double limit = 2 * alpha * 4 * side * side;
    EXPECT_LE(double(found), limit);
    EXPECT_GT(double(mutant), limit);
}

// The same where the noise changes abruptly: halves that differ by a factor of 20, and lines of one pixel.
TEST(Significance, NoiseThatChangesAtEdgesIsRarelySignificant) {
    constexpr double alpha = 1e-3;
    std::size_t at_edge = 0, on_lines = 0;
    for (unsigned trial = 0; trial < 4; ++trial) {
        const auto edge = [](int x, int) { return x < side / 2 ? 0.01 : 0.2; };
        at_edge +=
            count_nonzero(significant(measure(2 * trial + 101, edge), measure(2 * trial + 102, edge), alpha));
        const auto lines = [](int x, int) { return x % 8 ? 0.01 : 0.2; };
        on_lines += count_nonzero(
            significant(measure(2 * trial + 201, lines), measure(2 * trial + 202, lines), alpha));
    }
    constexpr double limit = 2 * alpha * 4 * side * side;
    EXPECT_LE(double(at_edge), limit);
    EXPECT_LE(double(on_lines), limit);
}

TEST(Significance, TrueDifferencesAreFound) {
    const auto even = [](int, int) { return 0.1; };
    auto a = measure(301, even);
    const auto b = measure(302, even);
    const double sigma = 0.1 / std::sqrt(randomisations) * std::numbers::sqrt2;  // of the difference
    for (int y = 40; y < 80; ++y)
        for (int x = 40; x < 80; ++x) a.mean.at(x, y) += float(7 * sigma);
    const auto found = significant(a, b, 1e-4);
    int inside = 0, outside = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool is_inside = x >= 40 && x < 80 && y >= 40 && y < 80;
            if (found.at(x, y) == 0) continue;
            (is_inside ? inside : outside) += 1;
            if (is_inside) {
                EXPECT_EQ(found.at(x, y), a.mean.at(x, y) - b.mean.at(x, y));
            }
        }
    EXPECT_GT(inside, 0.9 * 40 * 40);
    EXPECT_LE(outside, 8);
}

TEST(Significance, KnowsStudentsDistribution) {
    EXPECT_NEAR(student_quantile(0.05, 1), 12.706, 1e-3);  // [Abramowitz64 table 26.10]
    EXPECT_NEAR(student_quantile(0.05, 2), 4.303, 1e-3);
    EXPECT_NEAR(student_quantile(0.01, 7), 3.499, 1e-3);
    EXPECT_NEAR(student_quantile(0.002, 10), 4.144, 1e-3);
    EXPECT_NEAR(student_quantile(0.05, 100000), 1.960, 1e-3);
}

TEST(Significance, ASideWithoutVarianceHasNoNoise) {
    const Image a(8, 8, 3, 1.5f), b(8, 8, 3, 1), small(8, 8, 1, 1e-4f), large(8, 8, 1, 1);
    const auto result = [&](const Noise& noise) {
        return difference(a, b, DifferenceKind::significant, noise, nullptr, nullptr).image.at(3, 3, 1);
    };
    EXPECT_EQ(result({.variance_a = &small}), 0.5f);
    EXPECT_EQ(result({.variance_b = &small}), 0.5f);
    EXPECT_EQ(result({.variance_a = &small, .variance_b = &large}), 0);
}

TEST(Significance, RoundingIsNoDifference) {
    const Image none(4, 4, 1);
    Image a(4, 4, 1, 1000), b(4, 4, 1, std::nextafter(1000.0f, 2000.0f));
    const auto result =
        difference(a, b, DifferenceKind::significant, {.variance_a = &none}, nullptr, nullptr).image;
    EXPECT_EQ(count_nonzero(result), 0u);
}

TEST(Significance, PixelsWithoutAVarianceHaveNoValue) {
    const Image a(6, 6, 1, 2), b(6, 6, 1, 1);
    Image variance(6, 6, 1, 1e-4f), valid(6, 6, 1, 1);
    variance.at(2, 2) = std::numeric_limits<float>::quiet_NaN();
    valid.at(4, 4) = 0;
    variance.at(4, 4) = 1e9f;  // of an invalid pixel: its neighbours do not count it
    const auto result =
        difference(a, b, DifferenceKind::significant, {.variance_a = &variance}, &valid, nullptr);
    EXPECT_TRUE(std::isnan(result.image.at(2, 2)));
    EXPECT_EQ(result.valid.at(4, 4), 0);
    EXPECT_EQ(result.image.at(3, 3), 1);
    EXPECT_EQ(result.image.at(2, 3), 1);
}

TEST(Significance, RefusesToGuess) {
    const Image a(4, 4, 3), three(4, 4, 2), size(3, 4, 1), good(4, 4, 1);
    const auto compare = [&](const Noise& noise) {
        difference(a, a, DifferenceKind::significant, noise, nullptr, nullptr);
    };
    EXPECT_THROW(difference(a, a, DifferenceKind::significant), UsageError);
    EXPECT_THROW(compare({}), UsageError);
    EXPECT_THROW(compare({.variance_a = &three}), UsageError);
    EXPECT_THROW(compare({.variance_b = &size}), UsageError);
    EXPECT_THROW(compare({.variance_a = &good, .alpha = 0}), UsageError);
    EXPECT_THROW(compare({.variance_a = &good, .degrees = 0}), UsageError);
}

}  // namespace
}  // namespace ir
