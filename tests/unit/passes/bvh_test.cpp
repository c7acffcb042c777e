#include "renderers/passes/raytracing/bvh.h"
#include "renderers/core/constants.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <random>

#include "renderers/graph/graph.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/raytracing/embree_timing.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "tests/unit/passes/small_world.h"

namespace ir {
namespace {

using passes::Bvh;
using test::SmallWorld;

struct Ray {
    glm::vec3 origin, direction;
};

std::vector<Ray> random_rays(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        rays.push_back({{unit(random), unit(random), unit(random)}, test::random_direction(random)});
    }
    return rays;
}

/// Distance along the ray and the smallest barycentric coordinate, in double precision; nothing when
/// parallel.
struct Crossing {
    double distance, margin;
};
std::optional<Crossing> cross_triangle(const Ray& ray, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 o(ray.origin), d(ray.direction);
    const auto e1 = b - a, e2 = c - a, p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    if (std::abs(determinant) < 1e-12) return {};
    const auto s = o - a, q = glm::cross(s, e1);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant;
    return Crossing{glm::dot(e2, q) / determinant, std::min({u, v, 1 - u - v})};
}

/// The nearest hit found without any acceleration; `unsure` where a ray passes an edge or starts on a plane.
struct Expected {
    double distance = infinity;
    bool unsure = false;
};
Expected brute_force(const scene::World& world, const Ray& ray) {
    Expected result;
    for (std::size_t t = 0; t < world.triangles(); ++t) {
        const auto corner = [&](int i) { return glm::dvec3(world.positions[world.indices[3 * t + i]]); };
        const auto crossing = cross_triangle(ray, corner(0), corner(1), corner(2));
        if (!crossing) continue;
        if (std::abs(crossing->margin) < 1e-4 || std::abs(crossing->distance) < 1e-4) result.unsure = true;
        if (crossing->margin > 0 && crossing->distance > 0) {
            result.distance = std::min(result.distance, crossing->distance);
        }
    }
    return result;
}

Bvh::Packet16 make_packet(std::span<const Ray> rays, float near, float far) {
    Bvh::Packet16 packet;
    for (std::size_t i = 0; i < 16; ++i) {
        packet.active[i] = i < rays.size() ? -1 : 0;
        const auto ray = i < rays.size() ? rays[i] : Ray{{0, 0, 0}, {0, 1, 0}};
        packet.ox[i] = ray.origin.x, packet.oy[i] = ray.origin.y, packet.oz[i] = ray.origin.z;
        packet.dx[i] = ray.direction.x, packet.dy[i] = ray.direction.y, packet.dz[i] = ray.direction.z;
        packet.near[i] = near, packet.far[i] = far;
    }
    return packet;
}

TEST(Bvh, FindsTheNearestHitThatBruteForceFinds) {
    SmallWorld small;
    small.add_soup(200, 1);
    const auto world = small.world();
    const Bvh bvh(small.scene(), world);
    int compared = 0, hits = 0;
    for (const auto& ray : random_rays(3000, 2)) {
        const auto expected = brute_force(world, ray);
        if (expected.unsure) continue;
        ++compared;
        hits += expected.distance < infinity;
        const float found = bvh.closest(ray.origin, ray.direction, 0, infinity);
        ASSERT_EQ(found < infinity, expected.distance < infinity);
        if (found < infinity) {
            ASSERT_NEAR(found, expected.distance, 1e-4);
        }
        ASSERT_EQ(bvh.occluded(ray.origin, ray.direction, 0, infinity), found < infinity);
    }
    EXPECT_GT(compared, 2000);
    EXPECT_GT(hits, 1000);
}

TEST(Bvh, KeepsToTheGivenInterval) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 10);
    small.square({0, 4, 0}, {0, 1, 0}, 10);
    const Bvh bvh(small.scene(), small.world());
    const glm::vec3 origin(0.5f, -2, 0.25f), up(0, 1, 0);
    EXPECT_FLOAT_EQ(bvh.closest(origin, up, 0, infinity), 2);
    EXPECT_FLOAT_EQ(bvh.closest(origin, up, 3, infinity), 6);
    EXPECT_EQ(bvh.closest(origin, up, 3, 5), infinity);
    EXPECT_EQ(bvh.closest(origin, -up, 0, infinity), infinity);
    EXPECT_TRUE(bvh.occluded(origin, up, 0, 2.5f));
    EXPECT_FALSE(bvh.occluded(origin, up, 0, 1.5f));
    EXPECT_FALSE(bvh.occluded(origin, up, 6.5f, 100));
}

TEST(Bvh, PacketsAgreeWithSingleRays) {
    SmallWorld small;
    small.add_soup(60, 3);
    small.square({0, 0.3f, 0}, {0, 1, 0}, 0.7f, SmallWorld::masked);
    const Bvh bvh(small.scene(), small.world());
    const auto rays = random_rays(1600, 4);
    int differing = 0, hits = 0;
    for (std::size_t first = 0; first < rays.size(); first += 16) {
        const auto some = std::span(rays).subspan(first, 1 + first / 16 % 16);
        const auto packet = make_packet(some, 0.01f, 0.8f);
        for (const bool coherent : {false, true}) {
            float distances[16];
            bvh.closest16(packet, coherent, distances);
            const unsigned blocked = bvh.occluded16(packet, coherent);
            for (std::size_t i = 0; i < 16; ++i) {
                const float single =
                    i < some.size() ? bvh.closest(some[i].origin, some[i].direction, 0.01f, 0.8f) : infinity;
                hits += single < infinity;
                const bool same = distances[i] == single || std::abs(distances[i] - single) < 1e-5f;
                differing += !same || ((blocked >> i) & 1) != (single < infinity);
            }
        }
    }
    EXPECT_EQ(differing, 0);
    EXPECT_GT(hits, 200);
}

TEST(Bvh, WorksWithoutTriangles) {
    const SmallWorld small;
    const auto world = small.world();
    ASSERT_EQ(world.triangles(), 0u);
    const Bvh bvh(small.scene(), world);
    EXPECT_EQ(bvh.closest({0, 0, 0}, {0, 1, 0}, 0, infinity), infinity);
    EXPECT_FALSE(bvh.occluded({0, 0, 0}, {0, 1, 0}, 0, infinity));
    const auto rays = random_rays(16, 1);
    EXPECT_EQ(bvh.occluded16(make_packet(rays, 0, infinity), true), 0u);
}

TEST(Bvh, TakesDegenerateTriangles) {
    SmallWorld small;
    small.quad({1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0});
    small.square({0, 1, 0}, {0, 1, 0}, 1);
    const Bvh bvh(small.scene(), small.world());
    EXPECT_FLOAT_EQ(bvh.closest({0.2f, 0, 0.1f}, {0, 1, 0}, 0, infinity), 1);
}

class MaskedQuad : public testing::Test {
  protected:
    MaskedQuad() {
        small.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, SmallWorld::masked);
        small.square({0, 0, -3}, {0, 0, 1}, 10);
    }
    SmallWorld small;
    const glm::vec3 hole{0.5f, 0.4f, 1}, beside{1.5f, 0.4f, 1}, away{0, 0, -1};
};

TEST_F(MaskedQuad, LetsRaysThroughItsHole) {
    const Bvh bvh(small.scene(), small.world());
    EXPECT_FLOAT_EQ(bvh.closest(hole, away, 0, infinity), 4);
    EXPECT_FLOAT_EQ(bvh.closest(beside, away, 0, infinity), 1);
    EXPECT_FALSE(bvh.occluded(hole, away, 0, 3));
    EXPECT_TRUE(bvh.occluded(beside, away, 0, 3));
    EXPECT_TRUE(bvh.occluded(hole, away, 0, 5));
    EXPECT_FLOAT_EQ(bvh.closest(hole - glm::vec3(0, 0, 2), -away, 0, infinity), infinity);
}

TEST_F(MaskedQuad, LetsPacketsThroughItsHole) {
    const Bvh bvh(small.scene(), small.world());
    std::vector<Ray> rays;
    for (int i = 0; i < 16; ++i) rays.push_back({i % 3 ? hole : beside, away});
    for (const bool coherent : {false, true}) {
        const unsigned blocked = bvh.occluded16(make_packet(rays, 0, 3), coherent);
        float distances[16];
        bvh.closest16(make_packet(rays, 0, infinity), coherent, distances);
        for (int i = 0; i < 16; ++i) {
            EXPECT_EQ((blocked >> i) & 1, i % 3 ? 0u : 1u);
            EXPECT_FLOAT_EQ(distances[i], i % 3 ? 4 : 1);
        }
    }
}

TEST_F(MaskedQuad, OutlivesItsWorld) {
    std::unique_ptr<Bvh> bvh;
    {
        auto world = std::make_unique<scene::World>(small.world());
        bvh = std::make_unique<Bvh>(small.scene(), *world);
        std::fill(world->opacity_words.begin(), world->opacity_words.end(), ~0u);
        std::fill(world->positions.begin(), world->positions.end(), glm::vec3(9));
        std::fill(world->indices.begin(), world->indices.end(), 0u);
    }
    EXPECT_FLOAT_EQ(bvh->closest(hole, away, 0, infinity), 4);
    EXPECT_FLOAT_EQ(bvh->closest(beside, away, 0, infinity), 1);
}

/// The nearest triangle that is there, masks included, found without any acceleration.
struct ExpectedHit {
    double distance = infinity;
    std::size_t triangle = 0;
    bool unsure = false;  ///< a ray passes an edge, starts on a plane or meets the border of a texel
};
ExpectedHit brute_force_hit(const scene::Scene& scene, const scene::World& world, const Ray& ray) {
    ExpectedHit result;
    for (std::size_t t = 0; t < world.triangles(); ++t) {
        const auto corner = [&](std::size_t i) { return world.indices[3 * t + i]; };
        const auto at = [&](std::size_t i) { return glm::dvec3(world.positions[corner(i)]); };
        const auto crossing = cross_triangle(ray, at(0), at(1), at(2));
        if (!crossing) continue;
        if (std::abs(crossing->margin) < 1e-4 || std::abs(crossing->distance) < 1e-4) result.unsure = true;
        if (crossing->margin <= 0 || crossing->distance <= 0) continue;
        if (t >= world.opaque_triangles) {
            const auto point = glm::dvec3(ray.origin) + crossing->distance * glm::dvec3(ray.direction);
            const auto [u, v] = test::barycentric(point, at(0), at(1), at(2));
            const auto uv = (1 - u - v) * glm::dvec2(world.uv0[corner(0)]) +
                            u * glm::dvec2(world.uv0[corner(1)]) + v * glm::dvec2(world.uv0[corner(2)]);
            const auto border = glm::abs(2.0 * uv - glm::round(2.0 * uv));
            if (std::min(border.x, border.y) < 1e-3) result.unsure = true;
            const auto& sampler = scene.textures[0].sampler;
            if (!scene::is_covered(world, world.opacity[0], sampler, glm::vec2(uv))) continue;
        }
        if (crossing->distance < result.distance) result.distance = crossing->distance, result.triangle = t;
    }
    return result;
}

/// Opaque and masked triangles mixed up in space.
SmallWorld mixed_soup() {
    SmallWorld small;
    small.add_soup(60, 1);
    small.add_soup(120, 2, SmallWorld::masked);
    return small;
}

TEST(Bvh, HitsNameTrianglesOfTheWorldThroughMasksToo) {
    const auto small = mixed_soup();
    const auto world = small.world();
    ASSERT_EQ(world.opaque_triangles, 60u);
    const Bvh bvh(small.scene(), world);
    int compared = 0, opaque = 0, masked = 0;
    for (const auto& ray : random_rays(4000, 3)) {
        const auto expected = brute_force_hit(small.scene(), world, ray);
        if (expected.unsure) continue;
        ++compared;
        const auto hit = bvh.closest_hit(ray.origin, ray.direction, 0, infinity);
        ASSERT_EQ(hit.is_hit(), expected.distance < infinity);
        if (!hit.is_hit()) continue;
        ASSERT_EQ(hit.triangle, expected.triangle);
        ASSERT_NEAR(hit.distance, expected.distance, 1e-4);
        const auto corner = [&](std::size_t i) {
            return world.positions[world.indices[3 * hit.triangle + i]];
        };
        const auto point = (1 - hit.u - hit.v) * corner(0) + hit.u * corner(1) + hit.v * corner(2);
        ASSERT_LT(glm::distance(point, ray.origin + hit.distance * ray.direction), 1e-4f);
        (hit.triangle < world.opaque_triangles ? opaque : masked)++;
    }
    EXPECT_GT(compared, 2500);
    EXPECT_GT(opaque, 400);
    EXPECT_GT(masked, 400);
}

TEST(Bvh, HitsOfAWorldWithMasksOnlyCountFromZero) {
    SmallWorld small;
    small.quad({0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, SmallWorld::masked);
    const Bvh bvh(small.scene(), small.world());
    const auto lower = bvh.closest_hit({1.5f, 0.4f, 1}, {0, 0, -1}, 0, infinity);
    const auto upper = bvh.closest_hit({0.4f, 1.5f, 1}, {0, 0, -1}, 0, infinity);
    EXPECT_EQ(lower.triangle, 0u);
    EXPECT_EQ(upper.triangle, 1u);
    EXPECT_FALSE(bvh.closest_hit({0.5f, 0.4f, 1}, {0, 0, -1}, 0, infinity).is_hit());
}

TEST(Bvh, HitsOfPacketsAreThoseOfSingleRaysBitForBit) {
    auto small = mixed_soup();
    small.add_soup(3000, 5);
    const Bvh bvh(small.scene(), small.world());
    const auto rays = random_rays(6400, 6);
    int differing = 0;
    for (std::size_t first = 0; first < rays.size(); first += 16) {
        const auto some = std::span(rays).subspan(first, 1 + first / 16 % 16);
        passes::Hit hits[16];
        bvh.closest_hits16(make_packet(some, 0, infinity), false, hits);
        for (std::size_t i = 0; i < 16; ++i) {
            const auto single = i < some.size()
                                    ? bvh.closest_hit(some[i].origin, some[i].direction, 0, infinity)
                                    : passes::Hit{};
            differing += hits[i].distance != single.distance || hits[i].triangle != single.triangle ||
                         hits[i].u != single.u || hits[i].v != single.v;
        }
    }
    EXPECT_EQ(differing, 0);
}

/// Rays from about the middle of a closed sphere towards points of its edges: how many escape.
int escaping(Bvh::Edges edges) {
    const auto scene = scene::load_scene("builtin:furnace");
    const auto world = scene::flatten(scene, 0, 0);
    const Bvh bvh(scene, world, 0, edges);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    int escaped = 0;
    for (std::size_t i = 0; i < world.indices.size(); ++i) {
        const auto a = world.positions[world.indices[i]];
        const auto b = world.positions[world.indices[i % 3 == 2 ? i - 2 : i + 1]];
        for (int k = 0; k < 4; ++k) {
            const auto origin = world.bounds.centre() + 0.1f * test::random_direction(random);
            const auto direction = glm::normalize(glm::mix(a, b, unit(random)) - origin);
            escaped += !bvh.occluded(origin, direction, 0, infinity);
        }
    }
    return escaped;
}

TEST(Bvh, LetsNothingSlipThroughSharedEdges) {
    EXPECT_EQ(escaping(Bvh::Edges::watertight), 0);
    EXPECT_GT(escaping(Bvh::Edges::fast), 0);  // what the test would see otherwise
}

TEST(Bvh, CountsItsMemory) {
    SmallWorld few, many;
    few.add_soup(10, 1);
    many.add_soup(20000, 1);
    const auto world = many.world();
    const Bvh a(few.scene(), few.world()), b(many.scene(), world);
    EXPECT_GT(a.bytes(), 0u);
    EXPECT_GT(b.bytes(), a.bytes() + 20000 * 36);
    EXPECT_LT(b.bytes(), 20000u * 2000);
}

TEST(Bvh, LimitsNobodyElsesThreads) {
    using tbb::global_control;
    const auto before = global_control::active_value(global_control::max_allowed_parallelism);
    SmallWorld small;
    small.add_soup(10, 7);
    const Bvh one(small.scene(), small.world(), 1);
    EXPECT_EQ(global_control::active_value(global_control::max_allowed_parallelism), before);
}

TEST(Bvh, AnswersDoNotDependOnTheThreads) {
    SmallWorld small;
    small.add_soup(5000, 7);
    const auto world = small.world();
    const Bvh one(small.scene(), world, 1), two(small.scene(), world, 2);
    int differing = 0;
    for (const auto& ray : random_rays(2000, 8)) {
        differing += one.closest(ray.origin, ray.direction, 0, infinity) !=
                     two.closest(ray.origin, ray.direction, 0, infinity);
    }
    EXPECT_EQ(differing, 0);
}

/// Points of a tilted square around `centre`, rounded to floats as a G-buffer's are, and rays that leave
/// them: how many meet the square itself.
int self_hits(glm::vec3 centre, float half, bool with_offset) {
    SmallWorld small;
    const auto normal = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f));
    small.square(centre, normal, half);
    const auto world = small.world();
    const Bvh bvh(small.scene(), world);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto a = world.positions[0], b = world.positions[1], d = world.positions[3];
        const glm::dvec3 exact = glm::dvec3(a) + double(unit(random)) * glm::dvec3(b - a) +
                                 double(unit(random)) * glm::dvec3(d - a);
        const glm::vec3 position(exact);
        auto direction = test::random_direction(random);
        if (glm::dot(direction, normal) < 0) direction = -direction;
        const auto origin = with_offset ? passes::offset_origin(position, normal) : position;
        hits += bvh.occluded(origin, direction, 0, infinity);
    }
    return hits;
}

TEST(RayOffset, LeavesItsOwnSurfaceNearAndFarFromTheOrigin) {
    for (const float distance : {0.0f, 1.0f, 100.0f, 1e4f, 1e6f}) {
        const glm::vec3 centre(distance, -0.6f * distance, 0.2f * distance);
        EXPECT_EQ(self_hits(centre, 1 + 0.01f * distance, true), 0) << distance << " m from the origin";
    }
}

TEST(RayOffset, IsNeeded) {
    EXPECT_GT(self_hits({100, -60, 20}, 2, false), 1000);
}

TEST(RayOffset, IsSmall) {
    EXPECT_LT(passes::ray_offset({0, 0, 0}), 2e-6f);
    EXPECT_LT(passes::ray_offset({10, -3, 0}), 5e-5f);
    EXPECT_FLOAT_EQ(passes::ray_offset({-1000, 3, 0}), passes::ray_offset({2, 1000, 0}));
}

TEST(EmbreeTiming, TracesTheRaysAboveTheSurface) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 1);
    small.square({0, 1, 0}, {0, 1, 0}, 100);
    std::vector<glm::vec3> positions(37, glm::vec3(0)), normals(37, glm::vec3(0, 1, 0));
    normals[5] = glm::vec3(0);  // background
    const std::vector<glm::vec3> directions{{0, 1, 0},         {0, -1, 0}, {0.6f, 0.8f, 0},
                                            {-0.6f, -0.8f, 0}, {1, 0, 0},  {-1, 0, 0}};
    const auto timing =
        passes::time_embree_ao(small.scene(), small.world(), positions, normals, directions, infinity, 2);
    EXPECT_EQ(timing.rays, 36u * 2);
    EXPECT_EQ(timing.blocked, 36u * 2);
    EXPECT_GT(timing.build_ms, 0);
    EXPECT_GT(timing.trace_ms, 0);
    // Within reach is the square above in the direction straight up alone.
    const auto near =
        passes::time_embree_ao(small.scene(), small.world(), positions, normals, directions, 1.1f, 2);
    EXPECT_EQ(near.rays, 36u * 2);
    EXPECT_EQ(near.blocked, 36u);
}

/// The pass "BVH" in a graph without a GPU: runs for a new world only.
TEST(BvhPass, IsKeptWhileTheWorldStaysTheSame) {
    SmallWorld small;
    small.square({0, 2, 0}, {0, 1, 0}, 1);
    const auto world = small.world();
    graph::Method method;
    method.description.id = "probe";
    method.description.outputs = {{.key = "hit", .label = "Hit"}};
    method.setup = [](graph::GraphBuilder& builder, const Settings&) {
        const auto bvh = passes::bvh(builder);
        const auto hit = builder.image({.text = {.key = "hit", .label = "Hit"},
                                        .format = gl::Format::r32f,
                                        .extent = graph::Extent::fixed(1, 1)});
        builder.pass("probe", graph::Queue::cpu).reads(bvh).writes(hit).execute([=](graph::PassContext& c) {
            c.pixels<float>(hit)[0] = c.object<Bvh>(bvh)->closest({0, 0, 0}, {0, 1, 0}, 0, infinity);
        });
    };
    const auto device = gl::make_null_device();
    graph::Graph graph(*device, nullptr, nullptr);
    graph::FrameInputs inputs;
    inputs.scene = &small.scene();
    inputs.world = &world;
    inputs.view.width = inputs.view.height = 4;
    const auto bvh_runs = [&](const std::string& fingerprint) {
        inputs.geometry_fingerprint = fingerprint;
        const auto report = graph.run(method, {}, inputs);
        EXPECT_FLOAT_EQ(graph.read_image("hit")->pixels[0], 2);
        for (const auto& pass : report.passes) {
            if (pass.name == "BVH") return pass.slices > 0;
        }
        return false;
    };
    EXPECT_TRUE(bvh_runs("a"));
    EXPECT_FALSE(bvh_runs("a"));
    EXPECT_TRUE(bvh_runs("b"));
}

}  // namespace
}  // namespace ir
