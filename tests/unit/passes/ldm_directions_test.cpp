#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderers/core/error.h"
#include "renderers/passes/ldm/directions.h"

namespace ir::passes::ldm {
namespace {

double area(const Direction& d) {
    return (std::cos(d.colatitude_min) - std::cos(d.colatitude_max)) * (d.longitude_max - d.longitude_min);
}

/// Points on the border and inside of a region.
std::vector<glm::dvec3> samples(const Direction& d, int n) {
    std::vector<glm::dvec3> result;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            result.push_back(on_sphere(d.colatitude_min + (d.colatitude_max - d.colatitude_min) * i / n,
                                       d.longitude_min + (d.longitude_max - d.longitude_min) * j / n));
    return result;
}

class LdmDirections : public testing::TestWithParam<int> {};

TEST_P(LdmDirections, CoverTheSphereInEqualAreasThatAreAntipodal) {
    const int n = GetParam();
    const auto directions = leopardi_directions(n);
    ASSERT_EQ(directions.size(), static_cast<std::size_t>(n));
    double sum = 0;
    for (const auto& d : directions) {
        EXPECT_NEAR(area(d), 2 * std::numbers::pi / n, 1e-6);
        EXPECT_NEAR(glm::length(d.centre), 1, 1e-12);
        EXPECT_GE(d.centre.y, -1e-12);
        sum += area(d);
    }
    EXPECT_NEAR(sum, 2 * std::numbers::pi, 1e-6);
    // The kept regions and their negatives do not overlap: a point is in exactly one of them.
    const auto count_regions_of = [&](double colatitude, double longitude) {
        int found = 0;
        for (const auto& d : directions) {
            const auto inside = [&](double c, double l) {
                const double turns = std::floor((l - d.longitude_min) / (2 * std::numbers::pi));
                l -= 2 * std::numbers::pi * turns;
                return c >= d.colatitude_min && c < d.colatitude_max && l < d.longitude_max;
            };
            found += inside(colatitude, longitude);
            found += inside(std::numbers::pi - colatitude, longitude + std::numbers::pi);
        }
        return found;
    };
    for (int i = 0; i < 400; ++i) {
        const double colatitude = std::acos(1 - 2 * (i + 0.37) / 400), longitude = 2.399963 * i;
        EXPECT_EQ(count_regions_of(colatitude, longitude), 1) << colatitude << " " << longitude;
    }
}

TEST_P(LdmDirections, AreNeverParallel) {
    const auto directions = leopardi_directions(GetParam());
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_LT(std::abs(glm::dot(directions[i].centre, directions[j].centre)), 1 - 1e-6)
                << i << " " << j;
}

TEST_P(LdmDirections, LieInsideSmallRegions) {
    const int n = GetParam();
    for (const auto& d : leopardi_directions(n)) {
        const double colatitude = std::acos(std::min(1.0, d.centre.y));
        EXPECT_GE(colatitude, d.colatitude_min);
        EXPECT_LT(colatitude, d.colatitude_max);
        if (colatitude > 0) {
            double longitude = std::atan2(d.centre.z, d.centre.x);
            longitude +=
                2 * std::numbers::pi * std::ceil((d.longitude_min - longitude) / (2 * std::numbers::pi));
            EXPECT_GT(longitude, d.longitude_min);
            EXPECT_LT(longitude, d.longitude_max);
        }
        if (n < 8) continue;
        double diameter = 0;
        const auto points = samples(d, 8);
        for (const auto& p : points)
            for (const auto& q : points) diameter = std::max(diameter, glm::distance(p, q));
        EXPECT_LE(diameter, 5.5 / std::sqrt(2.0 * n));
    }
}

INSTANTIATE_TEST_SUITE_P(, LdmDirections,
                         testing::Values(1, 2, 3, 4, 5, 7, 8, 13, 32, 64, 100, 128, 257, 512),
                         testing::PrintToStringParamName());

TEST(LdmDirectionSet, OfFigureFiveHaveThirteenCollars) {
    // [Aalund15 Fig. 5]
    const auto counts = collar_counts(256);
    ASSERT_EQ(counts.size(), 13u);
    EXPECT_EQ(counts[6], 28);
    int sum = 2;
    for (int count : counts) sum += count;
    EXPECT_EQ(sum, 256);
    int on_equator = 0;
    for (const auto& d : leopardi_directions(128)) on_equator += std::abs(d.centre.y) < 1e-9;
    EXPECT_EQ(on_equator, 14);
}

TEST(LdmDirectionSet, SumOfCosinesStaysNearHalfTheirNumber) {
    // The discrete integral of cos over any hemisphere, in units of its exact value. [Aalund15 eq. 2]
    const auto spread = [](int n) {
        double least = 2, most = 0;
        for (int i = 0; i < 500; ++i) {
            const auto normal = on_sphere(std::acos(1 - 2 * (i + 0.5) / 500), 2.399963 * i);
            double sum = 0;
            for (const auto& d : leopardi_directions(n)) sum += std::abs(glm::dot(d.centre, normal));
            least = std::min(least, 2 * sum / n), most = std::max(most, 2 * sum / n);
        }
        return glm::dvec2(least, most);
    };
    EXPECT_GT(spread(32).x, 0.97);
    EXPECT_LT(spread(32).y, 1.03);
    EXPECT_GT(spread(128).x, 0.994);
    EXPECT_LT(spread(128).y, 1.006);
}

TEST(LdmDirectionSet, RefuseLessThanOne) {
    EXPECT_THROW(leopardi_directions(0), UsageError);
    EXPECT_THROW(collar_counts(7), UsageError);
}

TEST(LdmDirectionSet, NoCollarOfATiltedSetIsParallelToAnAxis) {
    const auto r = tilt();
    EXPECT_NEAR(glm::determinant(r), 1, 1e-9);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(glm::length(r[axis]), 1, 1e-9);
        EXPECT_LT(std::abs(r[1][axis]), 0.8);  // the pole
        EXPECT_GT(std::abs(r[1][axis]), 0.3);
    }
}

TEST(LdmDirectionSet, RandomRotationsAreRotationsThatDependOnSeedAndFrame) {
    glm::dvec3 mean{0};
    const int n = 4000;
    for (int frame = 0; frame < n; ++frame) {
        const auto r = random_rotation(7, frame);
        EXPECT_NEAR(glm::determinant(r), 1, 1e-9);
        EXPECT_NEAR(glm::length(r[0]), 1, 1e-9);
        mean += r[2] / double(n);
    }
    // Each component of a uniform direction has variance 1/3; 4 standard deviations.
    for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(mean[i]), 4 * std::sqrt(1.0 / 3 / n));
    EXPECT_EQ(random_rotation(7, 3), random_rotation(7, 3));
    EXPECT_NE(random_rotation(7, 3), random_rotation(7, 4));
    EXPECT_NE(random_rotation(7, 3), random_rotation(8, 3));
}

}  // namespace
}  // namespace ir::passes::ldm
