#include <gtest/gtest.h>

#include "ldm_oracle.h"

namespace ir::passes::ldm {
namespace {

constexpr StorageKind storages[] = {StorageKind::linked_lists, StorageKind::arrays};
constexpr BuilderKind builders[] = {BuilderKind::raster, BuilderKind::compute};

Options options(StorageKind storage, BuilderKind builder, int directions = 20, int resolution = 64) {
    Options result;
    result.storage = storage;
    result.builder = builder;
    result.directions = directions;
    result.resolution = resolution;
    return result;
}

void expect_sorted(const Lists& lists) {
    for (const auto& list : lists) ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));
}

/// At most `fraction` of the fragments may differ. Depths may by what a shift of 1/256 texel makes of the
/// slope: builders differ in whether the corners' depths move with them when they are snapped.
void expect_similar(const Lists& found, const Lists& expected, double fraction) {
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_LE(different_fragments(found, expected), fraction * total(expected));
    std::size_t far = 0, compared = 0;
    for (std::size_t t = 0; t < found.size(); ++t) {
        if (found[t].size() != expected[t].size()) continue;
        for (std::size_t i = 0; i < found[t].size(); ++i) {
            ++compared;
            far += std::abs(int(found[t][i]) - int(expected[t][i])) > 32;
        }
    }
    EXPECT_LT(far, 0.01 * compared);
}

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

TEST(LdmBuild, StoragesHoldEqualListsAndBuildersSimilarOnes) {
    const auto world = random_world(3000, 2);
    LdmBuild build;
    Lists of_builder[2];
    for (int b = 0; b < 2; ++b) {
        of_builder[b] = build.run(world, options(storages[0], builders[b]));
        expect_sorted(of_builder[b]);
        EXPECT_EQ(build.run(world, options(storages[1], builders[b])), of_builder[b]);
    }
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
    const auto compute = build.run(world, options(StorageKind::arrays, BuilderKind::compute, 48, 400));
    const auto raster = build.run(world, options(StorageKind::arrays, BuilderKind::raster, 48, 400));
    EXPECT_GT(total(raster), 2'000'000u);
    EXPECT_LE(different_fragments(raster, compute), 1e-4 * total(raster));
    const auto lists = build.run(world, options(StorageKind::linked_lists, BuilderKind::compute, 48, 400));
    EXPECT_EQ(lists, compute);
}

/// Parallel rectangles in a shuffled order, in a scene that is one metre wide.
TestWorld stack_of_rectangles(int layers, float depth) {
    TestWorld world;
    for (int i = 0; i < layers; ++i)
        world.add_quad({0, 0.001f * float(i * 7919 % layers), 0}, {1, 0, 0}, {0, 0, depth});
    world.add({0, 0, 1}, {0, 0, 1}, {0, 0, 1});
    world.finish();
    return world;
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

TEST(LdmBuild, DeepTexelsKeepEveryFragment) {
    // More layers than one invocation sorts, and so many that insertion takes more turns than drivers allow.
    const auto world = stack_of_rectangles(1200, 1);
    LdmBuild build;
    for (const auto builder : builders) {
        const auto arrays = build.run(world, options(StorageKind::arrays, builder, 2, 8));
        expect_sorted(arrays);
        for (int t = 0; t < 8 * 8; ++t) ASSERT_EQ(arrays[t].size(), 1200u);
        EXPECT_EQ(build.report.counters["ldm.max_layers"], 1200);
        EXPECT_EQ(build.run(world, options(StorageKind::linked_lists, builder, 2, 8)), arrays);
        for (int i = 1; i < 1200; ++i) ASSERT_GT(arrays[5][i], arrays[5][i - 1]);
    }
}

TEST(LdmBuild, GrowsFromAThousandthToTheSameLists) {
    const auto world = random_world(1500, 6);
    for (const auto storage : storages)
        for (const auto builder : builders) {
            const auto wanted = options(storage, builder, 12, 40);
            const auto expected = LdmBuild().run(world, wanted);
            LdmBuild small;
            graph::FrameOptions frame;
            frame.initial_capacity = 0.001;
            EXPECT_EQ(small.run(world, wanted, frame), expected);
            EXPECT_GT(small.report.counters["growth"], 0);
        }
}

TEST(LdmBuild, OverflowLeavesListsValid) {
    const auto world = random_world(1500, 7);
    for (const auto storage : storages)
        for (const auto builder : builders) {
            LdmBuild build;
            graph::FrameOptions frame;
            frame.initial_capacity = 0.1;
            frame.growth = graph::Growth::next_frame;
            const auto wanted = options(storage, builder, 12, 40);
            const auto lists = build.run(world, wanted, frame);  // .at() would throw for a bad link
            EXPECT_FALSE(build.report.complete);
            EXPECT_LE(total(lists), build.report.counters["ldm.fragments"]);
        }
}

}  // namespace
}  // namespace ir::passes::ldm
