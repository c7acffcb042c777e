// Maps that are built and queried on the host: against scan conversion, and each instruction set against the
// simplest.
#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/packing.hpp>

#include "instruction_sets.h"
#include "ldm_oracle.h"
#include "renderers/passes/ldm/host/first_hit.h"
#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/raytracing/alpha_masks.h"
#include "small_world.h"

namespace ir::passes::ldm {
namespace {

/// Restores the best one.
class LdmHost : public testing::Test {
  protected:
    ~LdmHost() override { force_instruction_set(0); }
};

/// All maps, band by band, as lists.
Lists built(const scene::Scene& scene, const scene::World& world, const std::vector<MapFrame>& frames,
            int resolution) {
    const auto meshlets = make_meshlets(world, 1);
    const AlphaMasks masks(scene, world);
    const int band = StreamedMap::band_rows(resolution);
    StreamedMap map(resolution, Holds::lists);
    BuildScratch scratch;
    Lists lists;
    for (const auto& frame : frames)
        for (int row = 0; row < resolution; row += band) {
            const int rows = std::min(band, resolution - row);
            build_map(meshlets, masks, frame, row, rows, map, scratch);
            for (int texel = 0; texel < rows * resolution; ++texel) {
                auto& list = lists.emplace_back(map.depths.begin() + map.begins[texel],
                                                map.depths.begin() + map.begins[texel + 1]);
                std::sort(list.begin(), list.end());
            }
        }
    return lists;
}

TEST_F(LdmHost, MapsMatchScanConversionWithEachInstructionSet) {
    EXPECT_GE(instruction_sets().size(), 2u);
    const auto random = random_world(3000, 1);
    for (const int resolution : {64, 333}) {
        const auto frames = fit_frames(leopardi_directions(resolution == 64 ? 20 : 3), random_rotation(2, 3),
                                       random.world.bounds, resolution);
        const auto expected = scan_convert(random.world, frames, resolution);
        for (const auto set : instruction_sets()) {
            force_instruction_set(set);
            SCOPED_TRACE(instruction_set() + " " + std::to_string(resolution));
            expect_similar(built(random.scene, random.world, frames, resolution), expected, 3e-5, 2, 5e-4);
        }
    }
}

TEST_F(LdmHost, TrianglesWithSharedEdgesCoverEveryTexelOnce) {
    // A square of triangles of all sizes, seen at right angles and filling the map.
    TestWorld world;
    std::mt19937 random(4);
    std::uniform_real_distribution<float> uniform(0, 1);
    const std::function<void(glm::vec3, glm::vec3, glm::vec3, int)> split = [&](glm::vec3 a, glm::vec3 b,
                                                                                glm::vec3 c, int depth) {
        if (depth == 0 || uniform(random) < 0.1f) return world.add(a, b, c);
        const auto middle =
            glm::mix(b, c, 0.5f);  // of the longest edge, which the neighbour splits there, too
        split(middle, a, b, depth - 1);
        split(middle, c, a, depth - 1);
    };
    split({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 11);
    split({1, 0, 1}, {0, 0, 1}, {1, 0, 0}, 11);
    world.finish();
    for (const int resolution : {50, 200, 777}) {
        const auto frames = fit_frames(leopardi_directions(1), glm::dmat3(1), world.world.bounds, resolution);
        for (const auto set : instruction_sets()) {
            force_instruction_set(set);
            const auto lists = built(world.scene, world.world, frames, resolution);
            std::size_t wrong = 0;
            for (const auto& list : lists) wrong += list.size() != 1;
            EXPECT_EQ(wrong, 0u) << instruction_set() << " " << resolution;
        }
    }
}

TEST_F(LdmHost, MapsLeaveOutTheHolesOfMasks) {
    test::SmallWorld small;
    small.add_soup(40, 5, test::SmallWorld::masked);
    small.add_soup(10, 6);
    const auto world = small.world();
    auto unmasked = world;
    unmasked.opaque_triangles = static_cast<std::uint32_t>(world.triangles());
    const auto frames = fit_frames(leopardi_directions(4), glm::dmat3(1), world.bounds, 60);
    const auto all = total(built(small.scene(), unmasked, frames, 60));
    const auto with_holes = total(built(small.scene(), world, frames, 60));
    EXPECT_LT(with_holes, all);
    EXPECT_GT(with_holes, all / 2);
}

TEST_F(LdmHost, OutermostDepthsAreThoseOfTheLists) {
    const auto random = random_world(2000, 7);
    const auto meshlets = make_meshlets(random.world, 1);
    const AlphaMasks masks(random.scene, random.world);
    for (const auto& frame : fit_frames(leopardi_directions(5), glm::dmat3(1), random.world.bounds, 100)) {
        StreamedMap lists(100, Holds::lists), outermost(100, Holds::outermost);
        BuildScratch scratch;
        build_map(meshlets, masks, frame, 0, 100, lists, scratch);
        build_map(meshlets, masks, frame, 0, 100, outermost, scratch);
        for (int t = 0; t < 100 * 100; ++t) {
            std::uint32_t far = 0, near = 0;
            for (auto i = lists.begins[t]; i < lists.begins[t + 1]; ++i) {
                far = std::max<std::uint32_t>(far, lists.depths[i]);
                near = std::max<std::uint32_t>(near, 65535u - lists.depths[i]);
            }
            ASSERT_EQ(outermost.outermost[t], far << 16 | near);
        }
    }
}

/// Points on the triangles, as a picture.
PixelTiles random_pixels(const scene::World& world, int side) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<glm::vec4> positions, normals;
    std::vector<std::uint64_t> halves;
    while (static_cast<int>(positions.size()) < side * side) {
        const auto* corner = &world.indices[3 * (random() % world.triangles())];
        const auto &a = world.positions[corner[0]], &b = world.positions[corner[1]],
                   &c = world.positions[corner[2]];
        const auto n = glm::cross(b - a, c - a);
        if (glm::length(n) < 1e-6f) continue;
        const float u = 0.5f * uniform(random), v = 0.5f * uniform(random);
        positions.emplace_back(a + u * (b - a) + v * (c - a), 0);
        normals.emplace_back(glm::normalize(n), 0);
        halves.push_back(glm::packHalf4x16(glm::vec4(glm::normalize(n), 0)));
    }
    PixelTiles tiles;
    fill_pixel_tiles(tiles, {side, side, positions, halves, normals});
    return tiles;
}

TEST_F(LdmHost, InstructionSetsGiveTheSameSums) {
    const auto random = random_world(3000, 1);
    const auto meshlets = make_meshlets(random.world, 1);
    const AlphaMasks masks(random.scene, random.world);
    const auto tiles = random_pixels(random.world, 61);
    const auto frames = fit_frames(leopardi_directions(9), glm::dmat3(1), random.world.bounds, 120);
    const float scale = sum_scale(9);
    const auto sums = [&](Holds holds, const SelfHitRule& rule, const Visibility& visibility) {
        StreamedMap map(120, holds);
        BuildScratch scratch;
        std::vector<std::uint32_t> result(tiles.count() * PixelTiles::pixels);
        for (const auto& frame : frames) {
            build_map(meshlets, masks, frame, 0, 120, map, scratch);
            add_visibility(tiles, 0, tiles.count(), std::span(&map, 1), rule, visibility, scale, result);
        }
        return result;
    };
    const SelfHitRule tangent{true, 3, 0.35f, 1, 1}, offset{false, 3, 0.35f, 1, 1};
    struct Setting {
        Holds holds;
        SelfHitRule rule;
        Visibility visibility;
    };
    const Setting settings[] = {{Holds::sloped_lists, tangent, {0.7f, false}},
                                {Holds::sloped_lists, tangent, {0.7f, true}},
                                {Holds::outermost, tangent, {}},
                                {Holds::lists, tangent, {}},
                                {Holds::lists, tangent, {0.7f, false}},
                                {Holds::lists, tangent, {0.7f, true}},
                                {Holds::lists, offset, {0.7f, true}}};
    for (const auto& setting : settings) {
        force_instruction_set(instruction_sets().back());
        const auto expected = sums(setting.holds, setting.rule, setting.visibility);
        for (const auto set : instruction_sets()) {
            force_instruction_set(set);
            const auto found = sums(setting.holds, setting.rule, setting.visibility);
            std::size_t far = 0;
            for (std::size_t i = 0; i < found.size(); ++i)
                far += std::abs(float(found[i]) - float(expected[i])) > 0.001f * scale;
            EXPECT_LE(far, found.size() / 200) << instruction_set();
            force_instruction_set(0);
        }
        force_instruction_set(0);
    }
    // Both ways to hold a map give the same answer, bit by bit.
    EXPECT_EQ(sums(Holds::outermost, tangent, {}), sums(Holds::lists, tangent, {}));
}

TEST_F(LdmHost, NodesKnowTheSlopesOfTheirTriangles) {
    // z = 0.5 x - 3 y over the unit square, cut into triangles of all sizes.
    TestWorld world;
    const auto at = [](float x, float y) { return glm::vec3(x, y, 0.5f * x - 3 * y); };
    const auto square = [&](float x, float y, float side) {
        world.add(at(x, y), at(x + side, y), at(x, y + side));
        world.add(at(x + side, y + side), at(x + side, y), at(x, y + side));
    };
    square(0, 0, 0.5f);
    for (int i = 0; i < 32; ++i)
        square(0.5f + 0.015625f * static_cast<float>(i % 8), 0.1f * static_cast<float>(i / 8), 0.015625f);
    for (int i = 0; i < 16; ++i)
        square(0.5f + 0.1f * static_cast<float>(i % 4), 0.5f + 0.1f * static_cast<float>(i / 4), 0.1f);
    world.finish();
    const auto meshlets = make_meshlets(world.world, 1);
    const AlphaMasks masks(world.scene, world.world);
    for (const int resolution : {40, 150})
        for (const auto& frame :
             fit_frames(leopardi_directions(5), glm::dmat3(1), world.world.bounds, resolution)) {
            const auto normal = glm::normalize(glm::vec3(-0.5f, 3, 1));
            const float facing = glm::dot(normal, glm::vec3(frame.direction));
            if (std::abs(facing) < 0.1f) continue;
            const auto expected = glm::vec2(glm::dot(normal, glm::vec3(frame.step_u)),
                                            glm::dot(normal, glm::vec3(frame.step_v))) /
                                  (-facing * frame.direction.w);
            // Half a step of the codes, and what small triangles gain when their corners are snapped.
            const float texel = StreamedMap::texel_quanta(frame);
            const auto widening = 1.0f + glm::abs(expected) / texel;
            const auto bound = texel * widening * widening * (1.2f / ldm_slope_steps) + 4.0f;
            for (const auto set : instruction_sets()) {
                force_instruction_set(set);
                StreamedMap sloped(resolution, Holds::sloped_lists), plain(resolution, Holds::lists);
                BuildScratch scratch;
                build_map(meshlets, masks, frame, 0, resolution, sloped, scratch);
                build_map(meshlets, masks, frame, 0, resolution, plain, scratch);
                EXPECT_EQ(sloped.begins, plain.begins);
                const auto count = sloped.begins.back();
                ASSERT_GT(count, 50u);
                for (std::uint32_t i = 0; i < count; ++i) {
                    ASSERT_EQ(sloped.depths[i], plain.depths[i]);
                    const auto slope = 0.5f * glm::vec2(sloped.slope_of[sloped.slopes[i] & 0xff],
                                                        sloped.slope_of[sloped.slopes[i] >> 8]);
                    ASSERT_LE(std::abs(slope.x - expected.x), bound.x) << instruction_set();
                    ASSERT_LE(std::abs(slope.y - expected.y), bound.y) << instruction_set();
                }
            }
        }
}

/// A floor at y = 0 for x < 0, and a ramp y = x for x > 0, both 6 m long.
TestWorld floor_and_ramp() {
    TestWorld world;
    const auto rectangle = [&](const glm::vec3& a, const glm::vec3& b) {
        const glm::vec3 length(0, 0, 6);
        world.add(a, b, a + length);
        world.add(b + length, b, a + length);
    };
    rectangle({-2, 0, -3}, {0, 0, -3});
    rectangle({0, 0, -3}, {2, 2, -3});
    world.finish();
    return world;
}

TEST_F(LdmHost, SlopesTellWhatLiesBesideAPointFromWhatOccludesIt) {
    const auto world = floor_and_ramp();
    const auto meshlets = make_meshlets(world.world, 1);
    const AlphaMasks masks(world.scene, world.world);
    // The floor, up to 0.3 m from the ramp.
    constexpr int side = 48;
    std::vector<glm::vec4> positions, normals(side * side, glm::vec4(0, 1, 0, 0));
    for (int i = 0; i < side * side; ++i)
        positions.emplace_back(-0.3f * (static_cast<float>(i % side) + 0.5f) / side, 0,
                               static_cast<float>(i / side) / side - 0.5f, 0);
    const std::vector<std::uint64_t> halves(side * side, glm::packHalf4x16(glm::vec4(0, 1, 0, 0)));
    PixelTiles tiles;
    fill_pixel_tiles(tiles, {side, side, positions, halves, normals});
    const auto wrong = [&](Holds holds) {
        StreamedMap map(60, holds);
        BuildScratch scratch;
        std::size_t count = 0;
        for (const auto& frame : fit_frames(leopardi_directions(32), glm::dmat3(1), world.world.bounds, 60)) {
            build_map(meshlets, masks, frame, 0, 60, map, scratch);
            std::vector<std::uint32_t> sums(tiles.count() * PixelTiles::pixels);
            add_visibility(tiles, 0, tiles.count(), std::span(&map, 1), {true, 3, 0.1f, 0, 1}, {100, false},
                           sum_scale(1), sums);
            const auto v = glm::vec3(frame.direction) * (frame.direction.y > 0 ? 1.0f : -1.0f);
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const auto p = positions[static_cast<std::size_t>(y * side + x)];
                    const float t = p.x / (v.y - v.x);  // where the ray meets the ramp's plane
                    const bool is_hit = t > 0 && p.x + t * v.x <= 2 && std::abs(p.z + t * v.z) <= 3;
                    count += (sums[tiles.place(x, y)] == 0) != is_hit;
                }
        }
        return static_cast<double>(count) / (32.0 * side * side);
    };
    const double plain = wrong(Holds::lists), sloped = wrong(Holds::sloped_lists);
    std::printf("beside a ramp plain nodes are wrong in %.4f of all directions, sloped ones in %.4f\n", plain,
                sloped);
    EXPECT_GT(plain, 0.01);
    EXPECT_LT(sloped, 0.85 * plain);
}

TEST_F(LdmHost, SinglePointsAreAnsweredAsTiles) {
    const auto random = random_world(3000, 1);
    const auto meshlets = make_meshlets(random.world, 1);
    const AlphaMasks masks(random.scene, random.world);
    const auto tiles = random_pixels(random.world, 40);
    const SelfHitRule rule{true, 3, 0.35f, 1, 1};
    for (const auto holds : {Holds::lists, Holds::sloped_lists})
        for (const auto& frame :
             fit_frames(leopardi_directions(3), glm::dmat3(1), random.world.bounds, 120)) {
            StreamedMap map(120, holds);
            BuildScratch scratch;
            build_map(meshlets, masks, frame, 0, 120, map, scratch);
            std::vector<std::uint32_t> sums(tiles.count() * PixelTiles::pixels);
            add_visibility(tiles, 0, tiles.count(), std::span(&map, 1), rule, {0.7f, false}, sum_scale(1),
                           sums);
            const PointTracer tracer(map, rule);
            const float reach = 0.7f / frame.direction.w;
            std::size_t different = 0, hits = 0;
            for (std::size_t i = 0; i < sums.size(); ++i) {
                hits += sums[i] == 0;
                const auto part = [&](const PixelTiles::Values(&v)[3]) {
                    return glm::vec3(v[0][i], v[1][i], v[2][i]);
                };
                const float facing = glm::dot(part(tiles.geometric_normal), glm::vec3(frame.direction));
                const auto hit = tracer.trace(part(tiles.position), part(tiles.geometric_normal), facing > 0);
                different += (sums[i] == 0) != (hit.is_found && hit.distance < reach);
            }
            EXPECT_LE(different, sums.size() / 200);
            EXPECT_GT(hits, sums.size() / 20);
            EXPECT_LT(hits, sums.size() * 19 / 20);
        }
}

TEST_F(LdmHost, SumsHoldAsManyMapsAsThereMayBe) {
    for (const int maps : {1, 2, 3, 255, 256, 257, 4096}) {
        EXPECT_LE(double{sum_scale(maps)} * maps, 0x1p31) << maps;
        EXPECT_GE(sum_scale(maps), 0x1p19f) << maps;
    }
}

}  // namespace
}  // namespace ir::passes::ldm
