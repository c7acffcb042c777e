#include "renderers/passes/raytracing/layered_depth_cube.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderers/core/constants.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

using passes::CubeMaps;
using passes::CubeOptions;
using passes::LayeredDepthCube;

struct TestRay {
    glm::vec3 origin, direction;
};

/// From places that are seen: hits of other random rays, moved off their surface by `lift` metres.
std::vector<TestRay> rays_from_surfaces(const scene::World& world, const passes::Bvh& bvh, std::size_t count,
                                        float lift) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<TestRay> rays;
    while (rays.size() < count) {
        const glm::vec3 at(unit(random), unit(random), unit(random));
        const auto from = glm::mix(world.bounds.min, world.bounds.max, at), along = random_direction(random);
        const auto hit = bvh.closest_hit(from, along, 0, infinity);
        if (!hit.is_hit()) continue;
        const auto corner = [&](std::size_t k) {
            return world.positions[world.indices[3 * hit.triangle + k]];
        };
        auto normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        if (glm::dot(normal, along) > 0) normal = -normal;
        auto next = random_direction(random);
        if (glm::dot(next, normal) < 0) next = -next;
        rays.push_back({from + hit.distance * along + lift * normal, next});
    }
    return rays;
}

struct Agreement {
    double hits = 0;            ///< of all rays
    double agree = 0;           ///< of these: both hit within a texel of each other, or both nothing
    double passed_through = 0;  ///< the cube hits something behind, or nothing
    double stopped_early = 0;   ///< the cube hits something before
};

Agreement compare(const LayeredDepthCube& cube, const passes::Bvh& bvh, const std::vector<TestRay>& rays) {
    Agreement result;
    const double part = 1.0 / static_cast<double>(rays.size());
    for (const auto& ray : rays) {
        const float expected = bvh.closest_hit(ray.origin, ray.direction, 0, infinity).distance,
                    found = cube.closest_hit(ray.origin, ray.direction, infinity).distance;
        if (expected < infinity) result.hits += part;
        const bool is_equal = expected == found || std::abs(expected - found) <= cube.texel();
        (is_equal ? result.agree : found > expected ? result.passed_through : result.stopped_early) += part;
    }
    return result;
}

TEST(LayeredDepthCube, FindsTheFirstOfTwoSquaresExactly) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 10);
    small.square({0, 4, 0}, glm::normalize(glm::vec3(0.3f, 1, 0.2f)), 10);
    const auto world = small.world();
    for (const auto maps : {CubeMaps::all, CubeMaps::closest}) {
        const LayeredDepthCube cube(small.scene(), world, {.resolution = 100, .maps = maps});
        const glm::vec3 origin(0.5f, -2, 0.25f), up(0, 1, 0);
        EXPECT_FLOAT_EQ(cube.closest_hit(origin, up, infinity).distance, 2);
        EXPECT_FLOAT_EQ(cube.closest_hit(origin, up, 2).distance, 2) << "no further is far enough";
        EXPECT_FALSE(cube.closest_hit(origin, up, 1.5f).is_hit());
        EXPECT_FALSE(cube.closest_hit(origin, -up, infinity).is_hit());
        EXPECT_FALSE(cube.closest_hit({40, -2, 0}, up, infinity).is_hit());
        // The second one is at y = 4 - 0.3 x - 0.2 z.
        const auto second = cube.closest_hit(origin + 3.0f * up, up, infinity);
        EXPECT_NEAR(second.distance, 4 - 0.3f * 0.5f - 0.2f * 0.25f - 1, 1e-5f);
        EXPECT_GE(second.triangle, 2u);
    }
}

TEST(LayeredDepthCube, WeightsLeadToThePoint) {
    SmallWorld small;
    small.add_soup(100, 1);
    const auto world = small.world();
    const LayeredDepthCube cube(small.scene(), world, {.resolution = 200});
    std::mt19937 random(2);
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        const TestRay ray{2.0f * random_direction(random), random_direction(random)};
        const auto hit = cube.closest_hit(ray.origin, ray.direction, infinity);
        if (!hit.is_hit()) continue;
        ++found;
        EXPECT_GE(std::min({hit.u, hit.v, 1 - hit.u - hit.v}), -1e-6f);
        const auto corner = [&](std::size_t k) {
            return world.positions[world.indices[3 * hit.triangle + k]];
        };
        const auto at = (1 - hit.u - hit.v) * corner(0) + hit.u * corner(1) + hit.v * corner(2);
        EXPECT_LT(glm::distance(at, ray.origin + hit.distance * ray.direction), 4 * cube.texel());
    }
    EXPECT_GT(found, 100);
}

TEST(LayeredDepthCube, HolesOfMasksLetRaysThrough) {
    SmallWorld small;
    small.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, SmallWorld::masked);
    small.square({0, 1, 0}, {0, 1, 0}, 2);
    const auto world = small.world();
    const LayeredDepthCube cube(small.scene(), world, {.resolution = 256});
    for (int z = 0; z < 16; ++z)
        for (int x = 0; x < 16; ++x) {
            const glm::vec3 origin((x + 0.5f) / 8 - 1, -1, (z + 0.5f) / 8 - 1);
            const bool is_hole = origin.x < 0 && origin.z < 0;
            EXPECT_FLOAT_EQ(cube.closest_hit(origin, {0, 1, 0}, infinity).distance, is_hole ? 2 : 1)
                << x << ' ' << z;
        }
}

TEST(LayeredDepthCube, NothingIsHitInAnEmptyWorld) {
    const SmallWorld small;
    const auto world = small.world();
    const LayeredDepthCube cube(small.scene(), world, {});
    EXPECT_FALSE(cube.closest_hit({0, 0, 0}, {0, 1, 0}, infinity).is_hit());
    EXPECT_EQ(cube.nodes(), 0u);
}

TEST(LayeredDepthCube, TheSameForAnyNumberOfThreads) {
    const Shot shot("builtin:atrium?detail=0.2", "", 8, 6);
    const LayeredDepthCube one(shot.scene, shot.world, {.resolution = 100}, 1),
        three(shot.scene, shot.world, {.resolution = 100}, 3);
    EXPECT_EQ(one.nodes(), three.nodes());
    std::mt19937 random(1);
    for (int i = 0; i < 3000; ++i) {
        const auto direction = random_direction(random);
        const auto a = one.closest_hit(shot.world.bounds.centre(), direction, infinity),
                   b = three.closest_hit(shot.world.bounds.centre(), direction, infinity);
        EXPECT_EQ(a.distance, b.distance);
        EXPECT_EQ(a.triangle, b.triangle);
    }
}

TEST(LayeredDepthCube, AClosedBoxOfTurnedWallsIsTight) {
    SmallWorld small;
    const auto turn = glm::mat3(glm::rotate(glm::mat4(1), 0.5f, glm::normalize(glm::vec3(1, 2, 3))));
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 normal(0), u(0), v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
            small.quad(turn * (normal - u - v), turn * (normal + u - v), turn * (normal + u + v),
                       turn * (normal - u + v));
        }
    const auto world = small.world();
    const passes::Bvh bvh(small.scene(), world);
    const LayeredDepthCube cube(small.scene(), world, {.resolution = 256});
    std::mt19937 random(7);
    std::vector<TestRay> rays;
    for (int i = 0; i < 20'000; ++i)
        rays.push_back({0.9f * turn * random_direction(random), random_direction(random)});
    const auto all = compare(cube, bvh, rays);
    EXPECT_NEAR(all.hits, 1, 1e-9);
    EXPECT_LT(all.passed_through, 0.01) << "strips of less than a texel along edges";
    EXPECT_LT(all.stopped_early, 0.005);
}

TEST(LayeredDepthCube, AgreesWithEmbreeTheMoreTheFinerItIs) {
    const Shot shot("builtin:atrium?detail=0.3", "", 8, 6);
    const passes::Bvh bvh(shot.scene, shot.world);
    const auto rays = rays_from_surfaces(shot.world, bvh, 20'000, 1e-3f);
    const auto agreement = [&](int resolution, CubeMaps maps) {
        const LayeredDepthCube cube(shot.scene, shot.world, {.resolution = resolution, .maps = maps});
        return compare(cube, bvh, rays).agree;
    };
    const double coarse = agreement(128, CubeMaps::all), fine = agreement(512, CubeMaps::all);
    EXPECT_GT(coarse, 0.8);
    EXPECT_GT(fine, 0.93);
    EXPECT_GT(fine, coarse);
    EXPECT_GT(fine, agreement(512, CubeMaps::closest)) << "what that map sees edge-on is missing";
}

}  // namespace
}  // namespace ir::test
