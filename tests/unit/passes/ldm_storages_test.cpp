// Every storage against depth peeling, with both builders: the same sorted lists, whatever the maps are like.
#include <gtest/gtest.h>

#include "ldm_fixture.h"
#include "small_world.h"

namespace ir::passes::ldm {
namespace {

/// What the others are compared with.
constexpr auto oracle = StorageKind::arrays;

bool has_fixed_layers(StorageKind storage) {
    return storage == StorageKind::fixed_arrays || storage == StorageKind::fixed_arrays_presorted;
}

/// Quanta by which a storage may round depths.
int rounding(StorageKind) {
    return 0;
}

/// Some of `all`, which is sorted as they are.
bool is_part(const std::vector<std::uint16_t>& some, const std::vector<std::uint16_t>& all) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

class LdmStorages : public testing::TestWithParam<std::tuple<StorageKind, BuilderKind>> {
  protected:
    static StorageKind storage() { return std::get<0>(GetParam()); }
    Options wanted(int directions, int resolution, int fixed_layers = 256) const {
        auto result = options(storage(), std::get<1>(GetParam()), directions, resolution);
        result.fixed_layers = fixed_layers;
        return result;
    }
    static Options by_oracle(Options options) {
        options.storage = oracle;
        return options;
    }

    /// Lists with room for at most `layers` (0: for all), as the storage promises them.
    void expect_holds(const Lists& found, const Lists& expected, std::size_t layers = 0) {
        ASSERT_EQ(found.size(), expected.size());
        if (!has_fixed_layers(storage())) layers = 0;
        for (std::size_t t = 0; t < found.size(); ++t) {
            auto list = expected[t];
            ASSERT_TRUE(std::is_sorted(found[t].begin(), found[t].end())) << t;
            if (layers > 0 && list.size() > layers) {
                ASSERT_EQ(found[t].size(), layers);
                if (storage() == StorageKind::fixed_arrays) {
                    ASSERT_TRUE(is_part(found[t], list)) << t;
                    continue;
                }
                list.resize(layers);
            }
            ASSERT_EQ(found[t].size(), list.size()) << t;
            for (std::size_t i = 0; i < list.size(); ++i)
                ASSERT_LE(std::abs(found[t][i] - list[i]), rounding(storage())) << t << " " << i;
        }
        EXPECT_EQ(build.report.counters["ldm.nodes"], total(found));
        EXPECT_EQ(build.report.counters["ldm.dropped"], total(expected) - total(found));
    }
    void expect_oracle(const scene::Scene& scene, const scene::World& world, const Options& options,
                       graph::FrameOptions frame = {}) {
        const auto expected = oracle_build.run(scene, world, by_oracle(options));
        expect_sorted(expected);
        expect_holds(build.run(scene, world, options, std::move(frame)), expected,
                     static_cast<std::size_t>(options.fixed_layers));
    }
    void expect_oracle(const TestWorld& world, const Options& options, graph::FrameOptions frame = {}) {
        expect_oracle(world.scene, world.world, options, std::move(frame));
    }

    LdmBuild build, oracle_build;
};

TEST_P(LdmStorages, HoldTheListsOfDepthPeeling) {
    const auto world = random_world(3000, 2);
    expect_oracle(world, wanted(20, 64));
    EXPECT_GT(build.report.counters["ldm.nodes"], 100'000);
}

TEST_P(LdmStorages, HoldTheFirstLayersWhereTheirNumberIsFixed) {
    const auto world = random_world(3000, 2);
    const auto smaller = random_world(700, 12);
    for (const int layers : {1, 2, 3, 16, 17, 33}) {
        expect_oracle(world, wanted(3, 31, layers));
        if (!has_fixed_layers(storage())) break;
        EXPECT_GT(build.report.counters["ldm.dropped"], 0);
        expect_oracle(smaller, wanted(3, 31, layers));  // what the buffers held before is gone
    }
}

TEST_P(LdmStorages, TakeAnySizeOfMaps) {
    const auto world = random_world(500, 3);
    for (const int resolution : {1, 2, 3, 33, 67})
        for (const int directions : {1, 13}) expect_oracle(world, wanted(directions, resolution));
}

TEST_P(LdmStorages, AreEmptyWhereThereIsNothing) {
    TestWorld speck;
    speck.add({0, 0, 0}, {0, 0, 0}, {1, 1, 1});  // covers no texel
    speck.finish();
    TestWorld nothing;
    nothing.finish();
    nothing.world.bounds = {glm::vec3(0), glm::vec3(1)};
    const auto world = random_world(300, 4);
    for (const auto* empty : {&speck, &nothing}) {
        expect_oracle(world, wanted(5, 20));
        EXPECT_EQ(total(build.run(*empty, wanted(5, 20))), 0u);
        EXPECT_EQ(build.report.counters["ldm.nodes"], 0);
    }
}

TEST_P(LdmStorages, LeaveOutTheHolesOfMasks) {
    test::SmallWorld small;
    small.add_soup(200, 5, test::SmallWorld::masked);
    small.add_soup(50, 6);
    const auto world = small.world();
    auto unmasked = world;
    unmasked.opaque_triangles = static_cast<std::uint32_t>(world.triangles());
    expect_oracle(small.scene(), world, wanted(9, 40));
    const auto kept = build.report.counters["ldm.nodes"];
    expect_oracle(small.scene(), unmasked, wanted(9, 40));
    EXPECT_LT(kept, build.report.counters["ldm.nodes"]);
}

TEST_P(LdmStorages, HoldDeepTexels) {
    // More layers than one invocation sorts, and so many that insertion takes more turns than drivers allow.
    for (const int layers : {40, 200, 1200}) {
        const auto world = stack_of_rectangles(layers, 1);
        expect_oracle(world, wanted(2, 8));
        if (has_fixed_layers(storage())) continue;
        const auto lists = build.run(world, wanted(2, 8));
        for (int t = 0; t < 8 * 8; ++t) ASSERT_EQ(lists[t].size(), static_cast<std::size_t>(layers));
        for (int i = 1; i < layers; ++i) ASSERT_GT(lists[5][i], lists[5][i - 1]);
    }
}

TEST_P(LdmStorages, HoldEqualDepthsAsOftenAsTheyAreThere) {
    TestWorld world;
    for (int i = 0; i < 37; ++i) world.add_quad({0, 0.2f * float(i % 3), 0}, {1, 0, 0}, {0, 0, 1});
    world.finish();
    expect_oracle(world, wanted(1, 24));
    expect_oracle(world, wanted(1, 24, 15));
}

TEST_P(LdmStorages, GrowFromAThousandthToTheSameLists) {
    const auto world = random_world(1500, 6);
    graph::FrameOptions frame;
    frame.initial_capacity = 0.001;
    expect_oracle(world, wanted(12, 40), frame);
    EXPECT_GT(build.report.counters["growth"], 0);
}

TEST_P(LdmStorages, HoldValidListsBeforeTheyHaveGrown) {
    const auto world = random_world(1500, 7);
    for (const double capacity : {0.1, 0.001}) {
        LdmBuild small;
        graph::FrameOptions frame;
        frame.initial_capacity = capacity;
        frame.growth = graph::Growth::next_frame;
        const auto lists = small.run(world, wanted(12, 40), frame);
        EXPECT_FALSE(small.report.complete);
        EXPECT_LE(total(lists), small.report.counters["ldm.fragments"]);
    }
}

TEST_P(LdmStorages, HoldTheSameListsInBatches) {
    const auto world = random_world(1500, 8);
    build.room = oracle_build.room = 1 << 17;
    const auto options = wanted(24, 60, 8);
    expect_oracle(world, options);
    EXPECT_EQ(build.report.counters["batches"], 1);
    graph::FrameOptions frame;
    frame.memory_budget = build.report.peak_memory_bytes * 8 / 10;
    expect_oracle(world, options, frame);
    EXPECT_GT(build.report.counters["batches"], 1);
}

TEST_P(LdmStorages, ReportBytesThatTheyReallyTake) {
    const auto world = random_world(1500, 9);
    expect_oracle(world, wanted(12, 40));
    const double bytes = build.report.counters["ldm.bytes"], nodes = build.report.counters["ldm.nodes"];
    EXPECT_GT(bytes, 1.0 * nodes);
}

INSTANTIATE_TEST_SUITE_P(, LdmStorages,
                         testing::Combine(testing::ValuesIn(all_storages), testing::ValuesIn(builders)),
                         [](const auto& info) {
                             auto name = key_of(std::get<0>(info.param)) +
                                         (std::get<1>(info.param) == BuilderKind::raster ? "-raster" : "");
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace ir::passes::ldm
