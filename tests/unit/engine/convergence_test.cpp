// The time that a picture whose samples add up takes to an error.
#include "app/engine/convergence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ir::engine {
namespace {

/// Squared error 1 / samples, 10 ms to begin with and 2 ms a sample.
std::vector<ConvergencePoint> monte_carlo() {
    std::vector<ConvergencePoint> points;
    for (const std::uint64_t samples : {1, 4, 16})
        points.push_back({samples, 10 + 2.0 * double(samples), 1.0 / double(samples)});
    return points;
}

TEST(Convergence, FollowsTheSamplesBetweenAndBeyondThePoints) {
    EXPECT_NEAR(ms_to_error(monte_carlo(), 1.0 / 4), 18, 1e-9);
    EXPECT_NEAR(ms_to_error(monte_carlo(), 1.0 / 8), 26, 1e-9);
    EXPECT_NEAR(ms_to_error(monte_carlo(), 1.0 / 100), 210, 1e-9);
}

TEST(Convergence, ABetterSequenceIsTakenAsMeasured) {
    const std::vector<ConvergencePoint> points{{1, 1, 1}, {4, 4, 1.0 / 16}};  // error as 1 / samples
    EXPECT_NEAR(ms_to_error(points, 1.0 / 4), 2, 1e-9);
    EXPECT_NEAR(ms_to_error(points, 1.0 / 32), 8, 1e-9) << "beyond what was measured no better than chance";
}

TEST(Convergence, TheFirstPointIsTheLeast) {
    EXPECT_EQ(ms_to_error(monte_carlo(), 2), 12);
    EXPECT_TRUE(std::isinf(ms_to_error(monte_carlo(), 0)));
    EXPECT_TRUE(std::isinf(ms_to_error(monte_carlo(), -1)));
}

TEST(Convergence, AnErrorThatRisesInBetweenCountsFromWhereItIsReached) {
    const std::vector<ConvergencePoint> points{{1, 1, 1}, {2, 2, 2}, {4, 4, 0.5}};
    EXPECT_NEAR(ms_to_error(points, 0.99), 2.84, 0.01);
    const std::vector<ConvergencePoint> exact{{1, 1, 1}, {2, 2, 0}};
    EXPECT_EQ(ms_to_error(exact, 0.25), 2);
}

}  // namespace
}  // namespace ir::engine
