// Every storage against depth peeling, with both builders: the same sorted lists, whatever the maps are like.
#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "ldm_fixture.h"
#include "renderers/passes/ldm/storages.h"
#include "small_world.h"

namespace ir::passes::ldm {
namespace {

/// What the others are compared with.
constexpr auto oracle = StorageKind::depth_peeling;

bool has_fixed_layers(StorageKind storage) {
    return storage == StorageKind::fixed_arrays || storage == StorageKind::fixed_arrays_presorted;
}

/// A texel's depths as a storage promises to hold them: of outermost ones two, and once if they are equal;
/// short ones stand for the middle of what is rounded to them, and one for all that are equal then.
std::vector<std::uint16_t> as_held(StorageKind storage, std::vector<std::uint16_t> depths) {
    if (storage == StorageKind::outermost && depths.size() > 1) {
        depths = {depths.front(), depths.back()};
        depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    }
    if (storage != StorageKind::packed_arrays) return depths;
    constexpr int away = 16 - packed_bits;
    for (auto& depth : depths) depth = static_cast<std::uint16_t>(depth >> away << away | 1 << (away - 1));
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    return depths;
}

/// Some of `all`, which is sorted as they are.
bool is_part(const std::vector<std::uint16_t>& some, const std::vector<std::uint16_t>& all) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

class LdmStorages : public testing::Test {
  protected:
    /// Lists with room for at most `layers` where their number is fixed, as the storage promises them.
    void expect_holds(const Options& options, const Lists& found, const Lists& expected) {
        const auto layers = has_fixed_layers(options.storage) ? static_cast<std::size_t>(options.fixed_layers)
                                                              : std::size_t(-1);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t t = 0; t < found.size(); ++t) {
            auto list = as_held(options.storage, expected[t]);
            ASSERT_TRUE(std::is_sorted(found[t].begin(), found[t].end())) << t;
            if (options.storage == StorageKind::fixed_arrays && list.size() > layers) {
                ASSERT_EQ(found[t].size(), layers);
                ASSERT_TRUE(is_part(found[t], list)) << t;
                continue;
            }
            list.resize(std::min(list.size(), layers));
            auto depths = found[t];
            // Of rounded nodes those with equal slopes are one, so more of them may be left.
            if (options.storage == StorageKind::packed_arrays && options.nodes == NodeKind::sloped)
                depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
            ASSERT_EQ(depths, list) << t;
        }
        EXPECT_EQ(build.report.counters["ldm.nodes"], total(found));
        EXPECT_EQ(build.report.counters["ldm.dropped"] + build.report.counters["ldm.merged"] +
                      build.report.counters["ldm.between"],
                  total(expected) - total(found));
        EXPECT_GE(build.report.counters["ldm.bytes"], packed_bits / 8.0 * total(found));
        const auto bytes = known_bytes(options, total(found));
        if (bytes && build.report.counters["batches"] == 1) {
            EXPECT_EQ(build.report.counters["ldm.bytes"], *bytes);
        }
    }

    /// What the published layouts take: of lists a head for each texel and 8 bytes for each node, of arrays a
    /// word for each row, 16 bits for each offset (one more than texels, in whole words) and for each depth,
    /// with slopes as many again.
    static std::optional<double> known_bytes(const Options& options, std::size_t nodes) {
        const double rows = double(options.directions) * options.resolution;
        switch (options.storage) {
            case StorageKind::linked_lists:
            case StorageKind::lists_then_sort:
                return 4 * rows * options.resolution + 8.0 * double(nodes);
            case StorageKind::arrays:
                return 4 * rows * (1 + (options.resolution + 2) / 2) +
                       (options.nodes == NodeKind::sloped ? 4.0 : 2.0) * double(nodes);
            case StorageKind::outermost:
                return 4 * rows * options.resolution;
            default:
                return {};
        }
    }

    /// All storages, with both builders, against the oracle. `after` is called with each, its lists and the
    /// oracle's.
    using After = std::function<void(const Options&, const Lists&, const Lists&)>;
    void expect_all(
        const scene::Scene& scene, const scene::World& world, Options wanted,
        const graph::FrameOptions& frame = {}, const After& after = [](auto&&...) {}) {
        for (const auto builder : builders) {
            wanted.builder = builder;
            wanted.storage = oracle;
            build.reset();
            const auto expected = build.run(scene, world, wanted);
            expect_sorted(expected);
            for (const auto storage : all_storages) {
                wanted.storage = storage;
                for (const auto nodes : {NodeKind::plain, NodeKind::sloped}) {
                    if (nodes == NodeKind::sloped && !may_keep_slopes(storage)) continue;
                    wanted.nodes = nodes;
                    SCOPED_TRACE(key_of(storage) +
                                 (builder == BuilderKind::raster ? ", raster" : ", compute") +
                                 (nodes == NodeKind::sloped ? ", sloped" : ""));
                    build.reset();
                    const auto found = build.run(scene, world, wanted, frame);
                    expect_holds(wanted, found, expected);
                    after(wanted, found, expected);
                }
                wanted.nodes = NodeKind::plain;
            }
        }
    }
    void expect_all(
        const TestWorld& world, const Options& wanted, const graph::FrameOptions& frame = {},
        const After& after = [](auto&&...) {}) {
        expect_all(world.scene, world.world, wanted, frame, after);
    }
    static Options wanted(int directions, int resolution, int fixed_layers = 256) {
        auto result = options(oracle, BuilderKind::compute, directions, resolution);
        result.fixed_layers = fixed_layers;
        return result;
    }

    LdmBuild build;
};

TEST_F(LdmStorages, HoldTheListsOfDepthPeeling) {
    expect_all(random_world(3000, 2), wanted(6, 64), {},
               [](const Options&, const Lists&, const Lists& all) { EXPECT_GT(total(all), 30'000u); });
}

TEST_F(LdmStorages, HoldTheFirstLayersWhereTheirNumberIsFixed) {
    const auto world = stack_of_rectangles(50, 0.7f);
    for (const int layers : {1, 3, 16, 17, 33})
        for (const auto storage : all_storages)
            if (has_fixed_layers(storage)) {
                auto options = wanted(3, 31, layers);
                const auto expected = build.run(world, options);
                options.storage = storage;
                SCOPED_TRACE(key_of(storage) + " " + std::to_string(layers));
                expect_holds(options, build.run(world, options), expected);
                EXPECT_GT(build.report.counters["ldm.dropped"], 0);
            }
}

TEST_F(LdmStorages, ForgetWhatTheyHeldBefore) {
    const auto world = random_world(800, 4), smaller = random_world(300, 12);
    TestWorld speck;
    speck.add({0, 0, 0}, {0, 0, 0}, {1, 1, 1});  // covers no texel
    speck.finish();
    TestWorld nothing;
    nothing.finish();
    nothing.world.bounds = {glm::vec3(0), glm::vec3(1)};
    auto options = wanted(5, 20);
    for (const auto builder : builders) {
        options.builder = builder;
        options.storage = oracle;
        build.reset();
        const auto expected = build.run(smaller, options);
        for (const auto storage : all_storages) {
            options.storage = storage;
            SCOPED_TRACE(key_of(storage));
            build.run(world, options);
            expect_holds(options, build.run(smaller, options), expected);
            for (const auto* empty : {&speck, &nothing}) {
                build.run(world, options);
                EXPECT_EQ(total(build.run(*empty, options)), 0u);
                EXPECT_EQ(build.report.counters["ldm.nodes"], 0);
            }
        }
    }
}

TEST_F(LdmStorages, TakeAnySizeOfMaps) {
    const auto world = random_world(500, 3);
    for (const int resolution : {1, 3, 67}) expect_all(world, wanted(resolution == 67 ? 3 : 13, resolution));
}

TEST_F(LdmStorages, LeaveOutTheHolesOfMasks) {
    test::SmallWorld small;
    small.add_soup(40, 5, test::SmallWorld::masked);
    small.add_soup(10, 6);
    const auto world = small.world();
    auto unmasked = world;
    unmasked.opaque_triangles = static_cast<std::uint32_t>(world.triangles());
    const auto all = total(build.run(small.scene(), unmasked, wanted(4, 30)));
    expect_all(small.scene(), world, wanted(4, 30), {},
               [&](const Options&, const Lists&, const Lists& with_holes) {
                   EXPECT_LT(total(with_holes), all);
                   EXPECT_GT(total(with_holes), all / 2);
               });
}

TEST_F(LdmStorages, HoldDeepTexels) {
    // More layers than one invocation sorts, and so many that insertion takes more turns than drivers allow.
    for (const int layers : {40, 700}) {
        const auto rises = [&](const Options& options, const Lists& found, const Lists&) {
            if (has_fixed_layers(options.storage) || options.storage == StorageKind::packed_arrays ||
                options.storage == StorageKind::outermost)
                return;
            for (int t = 0; t < 25; ++t) ASSERT_EQ(found[t].size(), static_cast<std::size_t>(layers));
            for (int i = 1; i < layers; ++i) ASSERT_GT(found[5][i], found[5][i - 1]);
        };
        expect_all(stack_of_rectangles(layers, 1), wanted(2, 5), {}, rises);
    }
}

TEST_F(LdmStorages, HoldEqualDepthsAsOftenAsTheyAreThere) {
    TestWorld world;
    for (int i = 0; i < 37; ++i) world.add_quad({0, 0.2f * float(i % 3), 0}, {1, 0, 0}, {0, 0, 1});
    world.finish();
    for (const int layers : {15, 40}) expect_all(world, wanted(1, 24, layers));
}

TEST_F(LdmStorages, GrowFromAThousandthToTheSameLists) {
    graph::FrameOptions frame;
    frame.initial_capacity = 0.001;
    expect_all(random_world(1500, 6), wanted(12, 40), frame, [&](const Options&, const Lists&, const Lists&) {
        EXPECT_GT(build.report.counters["growth"], 0);
    });
}

TEST_F(LdmStorages, HoldValidListsBeforeTheyHaveGrown) {
    const auto world = random_world(1500, 7);
    auto options = wanted(12, 40);
    for (const double capacity : {0.1, 0.001})
        for (const auto builder : builders)
            for (const auto storage : all_storages) {
                options.builder = builder;
                options.storage = storage;
                SCOPED_TRACE(key_of(options.storage));
                build.reset();
                graph::FrameOptions frame;
                frame.initial_capacity = capacity;
                frame.growth = graph::Growth::next_frame;
                const auto lists = build.run(world, options, frame);
                EXPECT_FALSE(build.report.complete);
                EXPECT_LE(total(lists), build.report.counters["ldm.fragments"]);
            }
}

TEST_F(LdmStorages, HoldTheSameListsInBatches) {
    const auto world = random_world(1500, 8);
    build.room = 1 << 17;
    auto options = wanted(24, 60, 8);
    for (const auto builder : builders) {
        options.builder = builder;
        options.storage = oracle;
        build.reset();
        const auto expected = build.run(world, options);
        for (const auto storage : all_storages) {
            options.storage = storage;
            SCOPED_TRACE(key_of(options.storage));
            build.reset();
            build.run(world, options);
            EXPECT_EQ(build.report.counters["batches"], 1);
            const auto bytes = build.report.counters["ldm.bytes"];
            graph::FrameOptions frame;
            frame.memory_budget = build.report.peak_memory_bytes * 8 / 10;
            build.reset();
            expect_holds(options, build.run(world, options, frame), expected);
            EXPECT_GT(build.report.counters["batches"], 1);
            EXPECT_NEAR(build.report.counters["ldm.bytes"], bytes, 0.3 * bytes);
        }
    }
}

}  // namespace
}  // namespace ir::passes::ldm
