#include <array>
#include <cmath>
#include <cstring>

#include "tests/unit/methods/photon_mapping_filtering_fixture.h"

namespace ir::test {
namespace {

using pm::FilterKernel;

constexpr int width = 70, height = 53;  // neither of whole work groups nor of whole blocks
const std::array kernels{FilterKernel::printed, FilterKernel::b3_spline};

std::array<double, 5> weights(FilterKernel kernel) {
    if (kernel == FilterKernel::printed) return {0.1, 0.2, 0.4, 0.2, 0.1};
    return {1.0 / 16, 1.0 / 4, 3.0 / 8, 1.0 / 4, 1.0 / 16};
}

/// The largest |D|/σ that a kernel allows: all neighbours equal, the centre not.
double largest_detail(FilterKernel kernel) {
    const double centre = weights(kernel)[2] * weights(kernel)[2];
    return std::sqrt((1 - centre) / centre);
}

/// S_{i+1} of red where nothing but the picture's border stops the filter.
std::vector<double> smoothed(const std::vector<double>& s, int stride, FilterKernel kernel) {
    const auto h = weights(kernel);
    std::vector<double> result(s.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0, total = 0;
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i) {
                    const int u = x + i * stride, v = y + j * stride;
                    if (u < 0 || v < 0 || u >= width || v >= height) continue;
                    sum += h[i + 2] * h[j + 2] * s[static_cast<std::size_t>(v) * width + u];
                    total += h[i + 2] * h[j + 2];
                }
            result[static_cast<std::size_t>(y) * width + x] = sum / total;
        }
    return result;
}

using SpatialFilterTest = FilteringTest;

TEST_F(SpatialFilterTest, AConstantStaysItself) {
    const auto shot = leaf(width, height);
    const glm::vec4 colour(0.3f, 2, 5, -1);
    const auto estimate = Estimate::constant(width, height, colour);
    for (const auto kernel : kernels)
        for (const int passes : {0, 1, 3, 6}) {
            const auto parameters = spatial(passes, passes == 1 ? 0 : 0.045f, kernel);
            filter_once(shot, estimate, parameters);
            const auto image = result(parameters), valid = read("valid");
            int inside = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const bool hit = valid.at(x, y) > 0;
                    inside += hit;
                    for (int c = 0; c < 4; ++c)
                        ASSERT_EQ(image.at(x, y, c), hit ? colour[c] : 0)
                            << x << ' ' << y << " passes " << passes;
                }
            EXPECT_GT(inside, 500);
            EXPECT_LT(inside, width * height - 500);
        }
}

TEST_F(SpatialFilterTest, EveryStrideIsTheConvolutionWithZeroesBetween) {
    const auto shot = wall(width, height);
    const auto estimate = Estimate::random(width, height, 1);
    for (const auto kernel : kernels) {
        filter_once(shot, estimate, spatial(6, 0, kernel));
        std::vector<double> s;
        for (const auto& v : estimate.value) s.push_back(v.r);
        for (int i = 0; i < 6; ++i) {
            s = smoothed(s, 1 << i, kernel);
            const auto level = read("filter.scaling", i + 1);
            double most = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    most =
                        std::max(most, std::abs(level.at(x, y) - s[static_cast<std::size_t>(y) * width + x]));
            // the wall's depth differs by rounding alone, which the weights see as 1e-4 of their tolerance
            EXPECT_LT(most, 1e-4) << "pass " << i;
        }
        EXPECT_LE(largest_difference(read("filter.irradiance"), read("filter.scaling", 6)), 1e-6)
            << "γ = 0 leaves the scaling coefficients alone";
    }
}

TEST_F(SpatialFilterTest, UnclippedDetailsGiveTheInputBackAndThePrintedSignDoesNot) {
    for (const auto& shot : {wall(width, height), leaf(width, height)})
        for (const auto kernel : kernels) {
            filter_once(shot, Estimate::random(width, height, 2), spatial(4, 2.48f, kernel));
            const auto before = read("filter.temporal"), after = read("filter.irradiance");
            EXPECT_LT(largest_difference(before, after), 2e-6);
            // S_N + Σ clamp(D_i) by the views, and as printed
            auto telescoped = read("filter.scaling", 4), printed = telescoped;
            for (int i = 0; i < 4; ++i) {
                const auto detail = read("filter.clipped", i);
                EXPECT_LT(largest_difference(detail, read("filter.detail", i)), 1e-6);
                for (std::size_t k = 0; k < detail.pixels.size(); ++k) {
                    telescoped.pixels[k] += detail.pixels[k];
                    printed.pixels[k] -= detail.pixels[k];
                }
            }
            EXPECT_LT(largest_difference(before, telescoped), 2e-6);
            EXPECT_GT(largest_difference(before, printed), 0.5) << "the mutant passes";
        }
}

TEST_F(SpatialFilterTest, DetailsStayWithinTheirBoundAndReachIt) {
    auto spikes = Estimate::constant(width, height, glm::vec4(0.1f));
    for (int y = 5; y < height; y += 16)
        for (int x = 5; x < width; x += 16) spikes.at(x, y) = glm::vec4(1);
    const auto noise = Estimate::random(width, height, 3);
    for (const auto kernel : kernels)
        for (const Estimate* estimate : std::array<const Estimate*, 2>{&spikes, &noise}) {
            // a slope's weights take from the centre's neighbours, and the spike's detail with them
            filter_once(estimate == &noise ? leaf(width, height) : wall(width, height), *estimate,
                        spatial(4, 1, kernel));
            double most = 0;
            for (int i = 0; i < 4; ++i) {
                const auto detail = read("filter.detail", i), sigma = read("filter.bound", i);
                for (std::size_t k = 0; k < detail.pixels.size(); ++k)
                    if (sigma.pixels[k] > 1e-6f)
                        most = std::max(most, 1.0 * std::abs(detail.pixels[k]) / sigma.pixels[k]);
            }
            EXPECT_LE(most, largest_detail(kernel) * 1.0001);
            if (estimate == &spikes) {
                EXPECT_GT(most, largest_detail(kernel) * 0.99);
            }
        }
    EXPECT_NEAR(largest_detail(FilterKernel::printed), 2.2913, 1e-4);
    EXPECT_NEAR(largest_detail(FilterKernel::b3_spline), 2.4721, 1e-4);
}

TEST_F(SpatialFilterTest, ClippingKeepsDetailsToTheirShareOfTheDeviation) {
    filter_once(wall(width, height), Estimate::random(width, height, 4), spatial(3, 0.5f));
    int clipped = 0;
    for (int i = 0; i < 3; ++i) {
        const auto detail = read("filter.detail", i), bound = read("filter.bound", i);
        const auto kept = read("filter.clipped", i);
        for (std::size_t k = 0; k < detail.pixels.size(); ++k) {
            const float d = detail.pixels[k], b = bound.pixels[k];
            ASSERT_EQ(kept.pixels[k], std::clamp(d, -b, b));
            clipped += std::abs(d) > b;
        }
    }
    EXPECT_GT(clipped, 1000);
}

/// One very bright pixel on grey: its neighbours' bounds are as wide as it is bright.
TEST_F(SpatialFilterTest, BoundedDarkDetailsLeaveNothingBlack) {
    auto estimate = Estimate::random(width, height, 7);
    for (auto& value : estimate.value) value = 0.5f + value;
    estimate.at(30, 25) = glm::vec4(2000);
    auto parameters = spatial(4, 0.045f);
    float least[2];
    for (const bool bounds : {false, true}) {
        parameters.bounds_dark_details = bounds;
        filter_once(wall(width, height), estimate, parameters);
        const auto image = read("filter.irradiance");
        least[bounds] = image.at(0, 0);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) least[bounds] = std::min(least[bounds], image.at(x, y, c));
    }
    EXPECT_LT(least[false], 0.1) << "black as published";
    EXPECT_GT(least[true], 0.4);
}

TEST_F(SpatialFilterTest, DirectionsTakeTheSameWeights) {
    filter_once(leaf(width, height), Estimate::random(width, height, 5), spatial(4, 0.3f));
    const auto value = read("filter.irradiance"), direction = read("filter.irradiance_direction");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            ASSERT_NEAR(value.at(x, y, 3), value.at(x, y, 0), 1e-6f);
            ASSERT_NEAR(direction.at(x, y, 0), value.at(x, y, 1), 1e-6f);
            ASSERT_NEAR(direction.at(x, y, 1), value.at(x, y, 2), 1e-6f);
        }
}

TEST_F(SpatialFilterTest, NothingLeaksOverStepsOfDepthOrNormal) {
    SmallWorld step, fold;
    step.square({-50, 0, 0}, {0, 0, 1}, 50);
    step.square({50, 0, -1}, {0, 0, 1}, 50);
    fold.quad({-20, -20, -20}, {0, -20, 0}, {0, 20, 0}, {-20, 20, -20});
    fold.quad({0, -20, 0}, {20, -20, -20}, {20, 20, -20}, {0, 20, 0});
    for (const auto* small : {&step, &fold}) {
        const Shot shot(small->scene(), looking({0, 0, 5}, {0, 0, 0}), 64, 64);
        Estimate estimate(64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 32; ++x) estimate.at(x, y) = glm::vec4(1);
        for (const auto kernel : kernels) {
            filter_once(shot, estimate, spatial(5, 0, kernel));
            const auto image = read("filter.irradiance");
            for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x)
                    ASSERT_NEAR(image.at(x, y), x < 32 ? 1 : 0, 2e-3)
                        << (small == &step ? "step " : "fold ") << x << ' ' << y;
            filter_once(wall(64, 64), estimate, spatial(5, 0, kernel));
            EXPECT_GT(read("filter.irradiance").at(34, 32), 0.2) << "without an edge";
        }
    }
}

TEST_F(SpatialFilterTest, ASlopeIsNoEdge) {
    // a floor to the horizon: neighbours along the slope count as much as those across it
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 30);
    const Shot shot(small.scene(), looking({0, 1, 0}, {0, 0.5f, -3}), 64, 64);
    Estimate estimate(64, 64);
    estimate.at(32, 50) = glm::vec4(1);
    filter_once(shot, estimate, spatial(1, 0));
    const auto image = read("filter.irradiance");
    EXPECT_GT(image.at(34, 50), 0.02f);
    EXPECT_NEAR(image.at(32, 51) / image.at(33, 50), 1, 0.06) << "as printed it is exp(-1/σ_z), 0.37";
}

TEST_F(SpatialFilterTest, TheSameInputGivesTheSameBytes) {
    const auto estimate = Estimate::random(width, height, 6);
    const auto parameters = spatial(4, 0.045f);
    filter_once(leaf(width, height), estimate, parameters);
    const auto first = result(parameters);
    filter_once(leaf(width, height), estimate, parameters);
    EXPECT_EQ(std::memcmp(first.pixels.data(), result(parameters).pixels.data(),
                          first.pixels.size() * sizeof(float)),
              0);
}

}  // namespace
}  // namespace ir::test
