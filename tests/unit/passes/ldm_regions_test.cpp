// The environment over the regions of the maps' directions.
#include "renderers/passes/ldm/regions.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>

#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

namespace ldm = passes::ldm;

/// Brighter towards +Y and towards +X, with a bright texel, which no sum may miss.
scene::Environment uneven(int width, int height, int shift = 0) {
    Image map(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                map.at((x + shift) % width, y, c) =
                    1 + float(height - y) / float(height) +
                    0.5f * std::sin(2 * std::numbers::pi_v<float> * float(x) / float(width)) +
                    (y == height / 3 && x == width / 5 ? 500.0f : 0.0f);
    return {glm::vec3(0), std::make_shared<const Image>(std::move(map))};
}

glm::vec3 mean(const std::vector<glm::vec3>& values) {
    return std::accumulate(values.begin(), values.end(), glm::vec3(0)) / float(values.size());
}

TEST(LdmRegions, HoldTheirCentresAndEqualParts) {
    for (const int count : {1, 2, 3, 17, 64, 128}) {
        const auto directions = ldm::leopardi_directions(count);
        const ldm::Regions regions(count);
        ASSERT_EQ(regions.size(), 2 * directions.size());
        for (std::size_t i = 0; i < directions.size(); ++i) {
            EXPECT_EQ(regions.find(directions[i].centre), 2 * i) << count;
            EXPECT_EQ(regions.find(-directions[i].centre), 2 * i + 1) << count;
        }
        std::mt19937 random(1);
        std::vector<int> found(regions.size());
        const int each = 2000, all = each * int(regions.size());
        for (int i = 0; i < all; ++i) ++found.at(regions.find(random_direction(random)));
        for (const int n : found) EXPECT_NEAR(n, each, 5 * std::sqrt(each)) << count;
    }
}

TEST(LdmRegions, OfAConstantSkyHaveItsRadiance) {
    for (const auto& light : ldm::region_radiance({glm::vec3(1, 2, 3), nullptr}, 32, glm::dmat3(1)))
        EXPECT_EQ(light, glm::vec3(1, 2, 3));
}

TEST(LdmRegions, HoldAllLightHoweverTheyAreTurned) {
    for (const int width : {16, 256}) {
        const auto sky = uneven(width, width / 2);
        const auto expected = mean(ldm::region_radiance(sky, 64, glm::dmat3(1)));
        EXPECT_GT(expected.r, 1.5f);
        for (int frame = 1; frame < 6; ++frame) {
            const auto turned = mean(ldm::region_radiance(sky, 64, ldm::random_rotation(3, frame)));
            // Points of a region tell its size within half a per cent, where the map is coarse.
            EXPECT_NEAR(turned.r / expected.r, 1, 0.01) << width;
        }
    }
}

// Columns of the map go from -X over -Z, +X and +Z: a quarter more is a turn that takes +X to +Z.
TEST(LdmRegions, TurnWithTheSky) {
    const auto still = ldm::region_radiance(uneven(256, 128), 32, glm::dmat3(1));
    const glm::dmat3 quarter(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0));  // +X to +Z
    const auto turned = ldm::region_radiance(uneven(256, 128, 64), 32, quarter);
    double worst = 0, unturned = 0;
    const auto beside = ldm::region_radiance(uneven(256, 128, 64), 32, glm::dmat3(1));
    for (std::size_t i = 0; i < still.size(); ++i) {
        worst = std::max(worst, std::abs(double(turned[i].r) / still[i].r - 1));
        unturned = std::max(unturned, std::abs(double(beside[i].r) / still[i].r - 1));
    }
    EXPECT_LT(worst, 0.02);
    EXPECT_GT(unturned, 0.2);
}

}  // namespace
}  // namespace ir::test
