// Whether volumes reach every pixel that they should, and each once: against all triangles, one by one.
#include <cmath>
#include <random>

#include "renderers/passes/raytracing/ray_offset.h"
#include "tests/unit/methods/volumes_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

struct Hit {
    double distance = -1;  ///< m; negative: none
    bool is_sure = true;   ///< not within rounding of an edge, the reach, or the origin
};

/// In double precision, both sides.
Hit nearest(const scene::World& world, glm::dvec3 o, glm::dvec3 d, double reach) {
    Hit hit;
    for (std::size_t i = 0; i < world.triangles(); ++i) {
        const glm::dvec3 a = world.positions[world.indices[3 * i]],
                         b = world.positions[world.indices[3 * i + 1]],
                         c = world.positions[world.indices[3 * i + 2]];
        const auto n = glm::cross(b - a, c - a);
        const double rise = glm::dot(n, d);
        if (rise == 0) continue;
        const double t = glm::dot(n, a - o) / rise;
        const auto [u, v] = barycentric(o + t * d, a, b, c);
        const double inside = std::min({u, v, 1 - u - v});
        if (inside < -1e-3 || t < -1e-7 || t > 1.001 * reach) continue;
        if (inside < 1e-3 || t < 1e-5 || t > 0.999 * reach || std::abs(rise) < 1e-3 * glm::length(n))
            hit.is_sure = false;
        if (inside < 0 || t <= 0 || t >= reach) continue;
        if (hit.distance < 0 || t < hit.distance) hit.distance = t;
    }
    return hit;
}

class VolumesCoverageTest : public VolumesTest {
  protected:
    /// Compares distances of all samples with those by brute force; how many were compared.
    int compare_hits(const Shot& shot, double reach, int samples, bool culling) {
        auto settings = bounced_volumes(reach, samples);
        settings["culling"] = culling;
        render(shot, settings, "accessibility", 11);
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        int compared = 0, missed = 0, wrong = 0;
        for (int layer = 0; layer < samples; ++layer) {
            const auto direction = read("bounce.directions", layer),
                       distance = read("bounce.distance", layer);
            for (int y = 0; y < distance.height; ++y)
                for (int x = 0; x < distance.width; ++x) {
                    if (direction.at(x, y, 3) == 0) continue;
                    const auto o = passes::offset_origin(rgb(position, x, y), rgb(normal, x, y));
                    const auto hit = nearest(shot.world, o, rgb(direction, x, y), reach);
                    if (!hit.is_sure) continue;
                    ++compared;
                    missed += hit.distance >= 0 && distance.at(x, y) < 0;
                    wrong += std::abs(distance.at(x, y) - std::max(hit.distance, -1.0)) > 1e-3;
                }
        }
        EXPECT_EQ(missed, 0);
        EXPECT_EQ(wrong, 0);
        return compared;
    }
};

SmallWorld random_triangles(unsigned seed, int triangles = 60) {
    SmallWorld world;
    world.square({0, -0.8f, 0}, {0, 1, 0}, 2);
    world.add_soup(triangles, seed);
    scene::Mesh needles;  // slivers, with angles near 0 and near 180 degrees
    needles.positions = {{-1, 0.2f, 0},     {1, 0.2f, 0.01f},   {1, 0.2f, 0},
                         {-0.5f, 0, -0.5f}, {0, 0.001f, -0.4f}, {0.5f, 0, -0.3f},
                         {0, -0.5f, 0},     {0.001f, 0.9f, 0},  {0, 0.9f, 0.001f}};
    needles.normals.assign(9, {0, 1, 0});
    needles.indices = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    world.add(std::move(needles));
    return world;
}

TEST_F(VolumesCoverageTest, EveryRayFindsWhatABruteForceSearchFinds) {
    int compared = 0;
    for (const unsigned seed : {1u, 2u})
        for (const double reach : {0.1, 0.7})
            for (const float height : {0.0f, 2.5f})
                for (const bool culling : {true, false}) {
                    const Shot shot(random_triangles(seed).scene(),
                                    volumes_camera({1.7f, 1.2f, 1.9f}, {0, -0.2f, 0}, height), 40, 32);
                    compared += compare_hits(shot, reach, 2, culling);
                }
    EXPECT_GT(compared, 20000);
}

TEST_F(VolumesCoverageTest, ViewersInsideOfVolumesMissNothing) {
    // In the middle of the soup, so that most volumes enclose the eye.
    for (const float height : {0.0f, 1.0f}) {
        const Shot shot(random_triangles(3).scene(),
                        volumes_camera({0.05f, 0.1f, 0.1f}, {0.7f, -0.4f, 0.3f}, height), 40, 32);
        EXPECT_GT(compare_hits(shot, 1.5, 2, true), 500) << height;
    }
}

/// Accessibility's sum counts each volume once: form factors of what is everywhere, as wholes, add up to what
/// the picture shows.
TEST_F(VolumesCoverageTest, EachVolumeCoversAPixelOnce) {
    for (const float height : {0.0f, 2.5f})
        for (const glm::vec3 eye : {glm::vec3(1.7f, 1.2f, 1.9f), glm::vec3(0.05f, 0.1f, 0.1f)}) {
            const auto world = random_triangles(4);
            const Shot shot(world.scene(), volumes_camera(eye, {0.7f, -0.4f, 0.3f}, height), 48, 32);
            const auto covering = render(shot, additive_volumes(20), "volumes.covering");
            const auto position = read("gbuffer.position");
            int shown = 0;
            for (int y = 0; y < covering.height; ++y)
                for (int x = 0; x < covering.width; ++x) {
                    if (position.at(x, y, 3) <= 0) continue;
                    ASSERT_EQ(covering.at(x, y), static_cast<float>(shot.world.triangles())) << x << " " << y;
                    ++shown;
                }
            EXPECT_GT(shown, 100);
        }
}

TEST_F(VolumesCoverageTest, CullingLeavesOutAtLeastHalfOfARoomBehindAWallAndNoBitOfThePicture) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 0, 1}, 3);  // the wall
    world.square({0, -1, 1}, {0, 1, 0}, 1);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int i = 0; i < 50; ++i)
        world.square({unit(random), unit(random), -2 + 0.5f * unit(random)}, {0, 0, 1}, 0.2f);
    const Shot shot(world.scene(), volumes_camera({0.3f, 0.5f, 4}, {0, 0, 0}), 48, 32);
    for (auto settings : {additive_volumes(0.5), bounced_volumes(0.5, 2)}) {
        settings["culling"] = true;
        const auto culled = render(shot, settings);
        EXPECT_GE(report.counters.at("volumes.culled"), 100);
        settings["culling"] = false;
        const auto whole = render(shot, settings);
        EXPECT_EQ(report.counters.at("volumes.culled"), 0);
        EXPECT_EQ(culled.pixels, whole.pixels);
    }
}

TEST_F(VolumesCoverageTest, ScenesWithoutTrianglesAreOpen) {
    SmallWorld world;
    const Shot shot(world.scene(), volumes_camera({0, 0, 4}, {0, 0, 0}), 16, 16);
    for (const auto& settings : {additive_volumes(0.5), bounced_volumes(0.5, 2)})
        for (const float value : render(shot, settings).pixels) ASSERT_EQ(value, 1);
}

}  // namespace
}  // namespace ir::test
