#include <gtest/gtest.h>

#include "ldm_oracle.h"

namespace ir::passes::ldm {
namespace {

constexpr StorageKind storages[] = {StorageKind::linked_lists, StorageKind::arrays};

TEST(LdmBuild, MatchesScanConversionOnTheHost) {
    const auto world = random_world(3000, 1);
    const auto frames = fit_frames(leopardi_directions(20), glm::dmat3(1), world.world.bounds, 64);
    const auto expected = scan_convert(world.world, frames, 64);
    ASSERT_GT(total(expected), 100'000u);
    LdmBuild build;
    for (const auto storage : storages) {
        const auto found = build.run(world, options(storage, BuilderKind::compute));
        expect_sorted(found);
        expect_similar(found, expected, 2e-5);
        EXPECT_EQ(build.report.counters["ldm.fragments"], total(found));
        EXPECT_EQ(build.report.counters["ldm.nodes"], total(found));
        EXPECT_EQ(build.report.counters["ldm.dropped"], 0);
    }
}

TEST(LdmBuild, BuildersGiveSimilarLists) {
    const auto world = random_world(3000, 2);
    LdmBuild build;
    Lists of_builder[2];
    for (int b = 0; b < 2; ++b) of_builder[b] = build.run(world, options(StorageKind::arrays, builders[b]));
    expect_similar(of_builder[0], of_builder[1], 1e-4);
}

TEST(LdmBuild, RotatedDirectionsGiveOtherMapsThatMatchTheHostToo) {
    const auto world = random_world(500, 3);
    auto turned = options(StorageKind::arrays, BuilderKind::compute, 7, 50);
    LdmBuild build;
    const auto plain = build.run(world, turned);
    turned.rotation = random_rotation(3, 4);
    const auto found = build.run(world, turned);
    EXPECT_NE(found, plain);
    expect_similar(
        found,
        scan_convert(world.world, fit_frames(leopardi_directions(7), turned.rotation, world.world.bounds, 50),
                     50),
        1e-4);
}

TEST(LdmBuild, SharedEdgesGiveExactlyOneFragment) {
    // A height field over a square: seen from above every texel inside has one fragment.
    TestWorld world;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-0.01f, 0.01f);
    constexpr int n = 37;
    std::vector<glm::vec3> points;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) {
            const bool border = x == 0 || y == 0 || x == n || y == n;
            points.emplace_back(float(x) / n + (border ? 0 : uniform(random)), uniform(random),
                                float(y) / n + (border ? 0 : uniform(random)));
        }
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto& a = points[y * (n + 1) + x];
            const auto& d = points[(y + 1) * (n + 1) + x + 1];
            world.add(a, points[y * (n + 1) + x + 1], d);
            world.add(a, d, points[(y + 1) * (n + 1) + x]);
        }
    world.finish();
    LdmBuild build;
    for (const auto storage : storages)
        for (const auto builder : builders) {
            const auto lists = build.run(world, options(storage, builder, 1, 128));
            for (const auto& list : lists) ASSERT_EQ(list.size(), 1u);
        }
}

TEST(LdmBuild, LoopLimitsOfDriversDoNotCutLargeTriangles) {
    // One triangle over all 400² texels of many maps: a thread per triangle would take millions of turns.
    TestWorld world;
    world.add({-3, 0.1f, -1}, {3, 0, -1.2f}, {0, 0.2f, 4});
    world.add_quad({-1, -0.5f, -1}, {0.1f, 0, 0}, {0, 0.1f, 0});
    world.finish();
    LdmBuild build;
    build.room = 1 << 21;
    const auto compute = build.run(world, options(StorageKind::arrays, BuilderKind::compute, 16, 400));
    const auto raster = build.run(world, options(StorageKind::arrays, BuilderKind::raster, 16, 400));
    EXPECT_GT(total(raster), 700'000u);
    EXPECT_LE(different_fragments(raster, compute), 1e-4 * total(raster));
    const auto lists = build.run(world, options(StorageKind::linked_lists, BuilderKind::compute, 16, 400));
    EXPECT_EQ(lists, compute);
}

TEST(LdmBuild, RowsOfMoreThan65535FragmentsWidenTheOffsets) {
    const auto world = stack_of_rectangles(165, 0.005f);
    LdmBuild build;
    const auto lists = build.run(world, options(StorageKind::arrays, BuilderKind::compute, 1, 400));
    expect_sorted(lists);
    EXPECT_EQ(total(lists), 2u * 400 * 165);
    for (const auto& list : lists) ASSERT_TRUE(list.empty() || list.size() == 165u);
    EXPECT_GE(build.report.counters["ldm.offset_words"], 400 * 402);
    EXPECT_GT(build.report.counters["growth"], 0);
}

}  // namespace
}  // namespace ir::passes::ldm
