// The nearest surfel along a pixel's ray wins.
#include "tests/unit/methods/dss_visible_fixture.h"

namespace ir::test {
namespace {

/// Of a level of discs: where the ray meets the first one in the order of distance. Independent of the
/// shaders.
struct TwinHit {
    double distance = -1;
    std::uint32_t surfel = 0;
};

TwinHit nearest_disc(const std::vector<dss::Surfel>& surfels, glm::dvec3 x, glm::dvec3 direction,
                     glm::dvec3 n, double scale = 1) {
    TwinHit nearest;
    for (std::size_t i = 0; i < surfels.size(); ++i) {
        const glm::dvec3 to_centre = glm::dvec3(surfels[i].centre_ws) - x, normal = surfels[i].normal_ws;
        const double t = glm::dot(normal, to_centre) / glm::dot(normal, direction);
        const double radius = scale * surfels[i].radius;
        const bool on_disc = t > 0 && glm::length(t * direction - to_centre) <= radius;
        if (!on_disc || glm::dot(n, to_centre) <= 1e-5) continue;
        if (nearest.surfel == 0 || t < nearest.distance) nearest = {t, static_cast<std::uint32_t>(i + 1)};
    }
    return nearest;
}

class DssVisible : public VisibleTest {};

std::vector<dss::Surfel> soup(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<dss::Surfel> surfels;
    for (int i = 0; i < n; ++i)
        surfels.push_back(disc({1.5f * unit(random), 1.2f + unit(random), 1.5f * unit(random)},
                               random_direction(random), 0.25f, static_cast<std::uint32_t>(i)));
    return surfels;
}

TEST_F(DssVisible, OneLevelIsExactRayCasting) {
    const auto shot = floor_shot(40);
    VisibleRun run{.surfels = soup(150, 1), .parameters = visible_parameters(2)};
    run.wanted = {"splats.*", "bounce.*", "gbuffer.*"};
    splat(shot, run);
    const auto positions = read("gbuffer.position"), normals = read("gbuffer.geometric_normal");
    int hits = 0, differ = 0, rays = 0;
    for (int sample = 0; sample < 2; ++sample) {
        const auto directions = read("bounce.directions", sample), nearest = read("splats.nearest", sample),
                   distances = read("bounce.distance", sample), levels = read("splats.hit_level", sample);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x, ++rays) {
                const auto twin = nearest_disc(run.surfels, rgb(positions, x, y), rgb(directions, x, y),
                                               rgb(normals, x, y));
                differ += nearest.at(x, y, 0) != float(twin.surfel);
                hits += twin.surfel != 0;
                EXPECT_EQ(levels.at(x, y, 0), nearest.at(x, y, 0) != 0 ? 0.0f : -1.0f);
                if (nearest.at(x, y, 0) == float(twin.surfel)) {
                    EXPECT_NEAR(distances.at(x, y, 0), twin.distance, 1e-4 * std::abs(twin.distance));
                }
            }
    }
    EXPECT_GT(hits, rays / 4);
    EXPECT_LE(differ, 2);  // at the edges of discs
}

}  // namespace
}  // namespace ir::test
