// The reference's estimator at single points against closed forms. Each mean is that of 256 independent seeds
// with 64 samples; the test is Student's t with 255 degrees of freedom. All comparisons of this file together
// are 16, so |t| < 4.7 holds for each with α = 1e-4 / 16 (two-sided 4.3e-6 at 4.7).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "renderers/methods/reference/visibility.h"
#include "tests/image/methods/reference_lab.h"
#include "tests/unit/passes/small_world.h"

namespace ir::methods::reference::closed_forms {
namespace {

using test::SmallWorld;
constexpr double critical_t = 4.7;
constexpr int seeds = 256;
constexpr std::uint64_t samples_per_seed = 64;

std::vector<Estimate> estimates(const passes::Bvh& bvh, const SurfacePoint& point, const VisibilityRule& rule,
                                int count = seeds, std::uint64_t samples = samples_per_seed,
                                DirectionSampler direction = cosine_direction) {
    std::vector<Estimate> result;
    for (int seed = 0; seed < count; ++seed) {
        Sums sums{};
        add_visibility(bvh, point, rule, PixelSamples(static_cast<std::uint64_t>(seed), 5, 9), {0, samples},
                       sums, direction);
        result.push_back(estimate(sums, samples, largest_variance_of_a_fraction));
    }
    return result;
}

double t_statistic(const std::vector<Estimate>& estimates, double expected) {
    const auto s = spread(estimates);
    return (s.mean - expected) / std::sqrt(s.variance / static_cast<double>(estimates.size()));
}

/// Mutant: uniform in solid angle instead of cosine-weighted.
glm::vec3 uniform_direction(glm::vec2 u, glm::vec3 n) {
    // cosine_direction has cosθ = √(1 - x); this x makes that uniform.
    return cosine_direction({1 - (1 - u.x) * (1 - u.x), u.y}, n);
}

/// A point on the floor y = 0 at the distance d from an endless wall x = 0.
struct Corner {
    Corner() {
        small.square({0, 0, 0}, {0, 1, 0}, 1000);
        small.square({0, 0, 0}, {1, 0, 0}, 1000);
        world = small.world();
        bvh = std::make_unique<passes::Bvh>(small.scene(), world);
    }
    static SurfacePoint at(float d) { return {{d, 0, 0}, {0, 1, 0}, {0, 1, 0}}; }
    SmallWorld small;
    scene::World world;
    std::unique_ptr<passes::Bvh> bvh;
};

/// The wall blocks the directions with ω_x < -d/r: on the disc below the hemisphere (Nusselt) the circular
/// segment beyond t = d/r, of area acos t - t √(1 - t²), out of π.
double corner_accessibility(double t) {
    return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / glm::pi<double>();
}

TEST(ReferenceClosedForms, CornerWithHardCutOff) {
    const Corner corner;
    for (const float t : {0.05f, 0.25f, 0.5f, 0.75f, 0.95f}) {
        const auto found = estimates(*corner.bvh, Corner::at(2 * t), {2, Transport::Falloff::hard});
        EXPECT_LT(std::abs(t_statistic(found, corner_accessibility(t))), critical_t) << "d/r = " << t;
    }
}

TEST(ReferenceClosedForms, CornerRejectsUniformDirections) {
    const Corner corner;
    const auto found = estimates(*corner.bvh, Corner::at(1), {2, Transport::Falloff::hard}, seeds,
                                 samples_per_seed, uniform_direction);
    EXPECT_GT(std::abs(t_statistic(found, corner_accessibility(0.5))), critical_t);
}

/// A floor below an endless ceiling at the height h.
struct Ceiling {
    explicit Ceiling(float height) {
        small.square({0, 0, 0}, {0, 1, 0}, 1000);
        small.square({0, height, 0}, {0, 1, 0}, 1000);
        world = small.world();
        bvh = std::make_unique<passes::Bvh>(small.scene(), world);
    }
    SmallWorld small;
    scene::World world;
    std::unique_ptr<passes::Bvh> bvh;
};

/// The ceiling is met at d = h/μ, μ = cosθ; with c = h/d_max the mean of V over the density 2μ is
/// ∫₀ᶜ 2μ dμ + ∫꜀¹ (c/μ)² 2μ dμ = c² (1 - 2 ln c).
double ceiling_accessibility(double c) {
    return c * c * (1 - 2 * std::log(c));
}

TEST(ReferenceClosedForms, CeilingWithSmoothFallOff) {
    const Ceiling ceiling(3);
    const SurfacePoint floor{{0.3f, 0, -0.2f}, {0, 1, 0}, {0, 1, 0}};
    for (const float c : {0.1f, 0.4f, 0.7f, 0.95f}) {
        const auto found = estimates(*ceiling.bvh, floor, {3 / c, Transport::Falloff::smooth});
        EXPECT_LT(std::abs(t_statistic(found, ceiling_accessibility(c))), critical_t) << "h/d_max = " << c;
    }
}

TEST(ReferenceClosedForms, CeilingWithHardCutOff) {
    const Ceiling ceiling(3);
    const SurfacePoint floor{{0.3f, 0, -0.2f}, {0, 1, 0}, {0, 1, 0}};
    for (const float c : {0.3f, 0.8f}) {  // open below cosθ = c: c²
        const auto found = estimates(*ceiling.bvh, floor, {3 / c, Transport::Falloff::hard});
        EXPECT_LT(std::abs(t_statistic(found, c * c)), critical_t) << "h/d_max = " << c;
    }
}

TEST(ReferenceClosedForms, CeilingRejectsUniformDirections) {
    const Ceiling ceiling(3);
    const SurfacePoint floor{{0.3f, 0, -0.2f}, {0, 1, 0}, {0, 1, 0}};
    const auto found = estimates(*ceiling.bvh, floor, {3 / 0.4f, Transport::Falloff::smooth}, seeds,
                                 samples_per_seed, uniform_direction);
    EXPECT_GT(std::abs(t_statistic(found, ceiling_accessibility(0.4))), critical_t);
}

TEST(ReferenceClosedForms, DirectionsBelowTheSurfaceAreClosed) {
    // Over an open plane whose shading normal is tilted by β, (1 + cos β) / 2 of the directions are above it.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 10);
    const auto world = small.world();
    const passes::Bvh bvh(small.scene(), world);
    for (const float beta : {0.2f, 0.6f, 1.2f}) {
        const SurfacePoint point{{0, 0, 0}, {0, 1, 0}, {std::sin(beta), std::cos(beta), 0}};
        const auto found = estimates(bvh, point, {});
        EXPECT_LT(std::abs(t_statistic(found, (1 + std::cos(beta)) / 2)), critical_t) << "β = " << beta;
    }
}

TEST(ReferenceClosedForms, OpenPlaneIsExactlyOneEverywhere) {
    for (const float distance : {0.0f, 10.0f, 1e5f}) {
        SmallWorld small;
        const auto normal = glm::normalize(glm::vec3(0.2f, 0.9f, -0.4f));
        const glm::vec3 centre(distance, 0.5f * distance, -distance);
        small.square(centre, normal, 2);
        const auto world = small.world();
        const passes::Bvh bvh(small.scene(), world);
        const SurfacePoint point{centre, normal, normal};
        for (const auto& e : estimates(bvh, point, {}, 50)) {
            EXPECT_EQ(e.mean, 1);
            EXPECT_EQ(e.variance, 0);
        }
        for (const auto& e : estimates(bvh, point, {5, Transport::Falloff::smooth}, 50)) EXPECT_EQ(e.mean, 1);
    }
}

class MaskedCover : public testing::Test {
  protected:
    /// V over the floor below these quads.
    static double accessibility(const SmallWorld& small) {
        const auto world = small.world();
        const passes::Bvh bvh(small.scene(), world);
        return estimates(bvh, {{0.1f, 0, 0.2f}, {0, 1, 0}, {0, 1, 0}}, {}, 1, 1024).front().mean;
    }
};

TEST_F(MaskedCover, LetsLightThroughItsHole) {
    SmallWorld opaque, masked, hole_only;
    const glm::vec3 a(-1, 1, -1), b(1, 1, -1), c(1, 1, 1), d(-1, 1, 1);
    opaque.quad(a, b, c, d);
    masked.quad(a, b, c, d, SmallWorld::masked);
    // The first of 2 × 2 texels is missing: the quarter at corner a.
    hole_only.quad(a, {0, 1, -1}, {0, 1, 0}, {-1, 1, 0});
    // The same directions: what the mask blocks and what its hole would block make up the whole.
    EXPECT_GT(accessibility(masked), accessibility(opaque) + 0.05);
    EXPECT_NEAR(1 - accessibility(masked) + 1 - accessibility(hole_only), 1 - accessibility(opaque),
                1.01 / 1024);
}

/// Mean of the estimated variances over the variance between 4000 seeds. The latter is known to 2.2 %, the
/// former (7 degrees of freedom each) to 0.9 %: 3.9 standard deviations (α = 1e-4) are 9.4 %.
constexpr int many_seeds = 4000;
double variance_ratio(const std::vector<Estimate>& found) {
    double mean = 0;
    for (const auto& e : found) mean += e.variance / static_cast<double>(found.size());
    return mean / spread(found).variance;
}

TEST(ReferenceVariance, IsThatBetweenSeeds) {
    const Corner corner;
    for (const std::uint64_t samples : {4, 8, 64}) {
        const auto found =
            estimates(*corner.bvh, Corner::at(1), {2, Transport::Falloff::hard}, many_seeds, samples);
        EXPECT_NEAR(variance_ratio(found), 1, 0.094) << samples << " samples";
    }
    const auto smooth =
        estimates(*corner.bvh, Corner::at(1), {2, Transport::Falloff::smooth}, many_seeds, 32);
    EXPECT_NEAR(variance_ratio(smooth), 1, 0.094);
}

TEST(ReferenceVariance, TestRejectsTheVarianceOfIndependentSamples) {
    // Mutant: p (1 - p) / n, as if the points of a low-discrepancy sequence were independent.
    const Corner corner;
    auto found = estimates(*corner.bvh, Corner::at(1), {2, Transport::Falloff::hard}, many_seeds, 64);
    for (auto& e : found) e.variance = e.mean * (1 - e.mean) / 63;
    EXPECT_GT(std::abs(variance_ratio(found) - 1), 0.094);
}

TEST(ReferenceVariance, FallsFasterThanThatOfIndependentSamples) {
    const Corner corner;
    const auto variance = [&](std::uint64_t samples) {
        return spread(estimates(*corner.bvh, Corner::at(1), {2, Transport::Falloff::hard}, 1000, samples))
            .variance;
    };
    EXPECT_LT(variance(512), 0.5 * variance(8) * 8 / 512);
}

}  // namespace
}  // namespace ir::methods::reference::closed_forms
