#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// Writes `need` numbers into a buffer that was estimated at `estimate`, clamped at its capacity, counting
/// all of them; then adds them up, on top of the previous frame's sum.
struct Growing {
    std::uint64_t estimate = 4;
    std::uint32_t need = 100;
    std::string fingerprint;
    int fills = 0, sums = 0;

    Declare declare() {
        return [this](GraphBuilder& builder) {
            auto desc = buffer_of("list", estimate);
            desc.growable = true;
            desc.cleared = true;
            desc.fingerprint = fingerprint;
            const auto list = builder.buffer(desc);
            const auto count = builder.counter({.key = "list.count", .label = "", .growth_of = list});
            auto total_desc = image_of("total");
            total_desc.fingerprint = fingerprint;
            const auto total = builder.image(total_desc),
                       accumulated = builder.image(image_of("accumulated"));
            builder.pass("fill", Queue::cpu).writes(list).counts(count).execute([=, this](PassContext& p) {
                ++fills;
                const auto space = p.elements<std::uint32_t>(list);
                EXPECT_EQ(space.size(), p.capacity(list));
                for (std::uint32_t i = 0; i < need; ++i) {
                    if (i < space.size()) space[i] = i + 1;
                    p.add(count, 1);
                }
            });
            builder.pass("sum", Queue::cpu).reads(list).writes(total).execute([=, this](PassContext& p) {
                ++sums;
                float sum = 0;
                for (const auto x : p.elements<std::uint32_t>(list)) sum += static_cast<float>(x);
                for (float& x : p.pixels<float>(total)) x = sum;
            });
            builder.pass("accumulate", Queue::cpu)
                .reads(total)
                .reads_previous(accumulated)
                .writes(accumulated)
                .execute([=](PassContext& p) {
                    const auto before = p.previous_contents<float>(accumulated);
                    const auto now = p.pixels<float>(accumulated), add = p.pixels<float>(total);
                    for (std::size_t i = 0; i < now.size(); ++i) now[i] = before[i] + add[i];
                });
        };
    }
    float expected() const { return 0.5f * static_cast<float>(need) * static_cast<float>(need + 1); }
};

TEST_F(GraphTest, AnOverflowingFrameRunsAgainUntilItIsComplete) {
    Growing small, large;
    large.estimate = 1000;
    const auto report = run(small.declare());
    EXPECT_TRUE(report.complete);
    EXPECT_GE(report.counters.at("growth"), 1);
    EXPECT_EQ(report.counters.at("list.count"), 100);
    EXPECT_EQ(resource_of(report, "list").elements, 100u);
    EXPECT_EQ(small.fills, 2);
    EXPECT_EQ(small.sums, 1) << "what would be thrown away is not computed";
    const float grown = graph->read_image("accumulated")->at(0, 0, 0);

    Graph other(*device, nullptr, nullptr);
    Method method;
    method.setup = [&](GraphBuilder& builder, const Settings&) { large.declare()(builder); };
    EXPECT_EQ(other.run(method, {}, inputs, options).counters.at("growth"), 0);
    EXPECT_EQ(grown, other.read_image("accumulated")->at(0, 0, 0));
    EXPECT_EQ(grown, small.expected());
}

/// The frame is not cut short by the first of several passes whose counts add up.
TEST_F(GraphTest, PassesThatCountTogetherGrowABufferOnce) {
    int fills = 0;
    const auto report = run([&](GraphBuilder& builder) {
        auto desc = buffer_of("list", 4);
        desc.growable = true;
        const auto list = builder.buffer(desc);
        const auto count = builder.counter({.key = "list.count", .label = "", .growth_of = list});
        for (const char* name : {"a", "b", "c"})
            builder.pass(name, Queue::cpu)
                .writes(list)
                .counts(count)
                .execute([&fills, count](PassContext& p) {
                    ++fills;
                    p.add(count, 10);
                });
    });
    EXPECT_EQ(report.counters.at("growth"), 1);
    EXPECT_EQ(report.counters.at("list.count"), 30);
    EXPECT_EQ(fills, 6);
}

TEST_F(GraphTest, InitialCapacityScalesTheEstimate) {
    Growing growing;
    growing.estimate = 1000;
    options.initial_capacity = 0.01;
    EXPECT_EQ(run(growing.declare()).counters.at("growth"), 1);
    EXPECT_EQ(graph->read_image("total")->at(0, 0, 0), growing.expected());
}

TEST_F(GraphTest, GrowthInAFourthFrameKeepsTheHistory) {
    Growing growing;
    growing.estimate = 10;
    growing.need = 8;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(run(growing.declare()).counters.at("growth"), 0);
    growing.need = 50;
    EXPECT_EQ(run(growing.declare()).counters.at("growth"), 1);
    EXPECT_EQ(graph->read_image("accumulated")->at(0, 0, 0), 3 * 36 + growing.expected());
}

TEST_F(GraphTest, LiveFramesAreOneLateAndSaySo) {
    Growing growing;
    growing.need = 3;
    options.growth = Growth::next_frame;
    EXPECT_TRUE(run(growing.declare()).complete);
    growing.need = 100;
    const auto incomplete = run(growing.declare());
    EXPECT_FALSE(incomplete.complete);
    EXPECT_FALSE(incomplete.messages.empty());
    EXPECT_EQ(growing.fills, 2);
    const auto complete = run(growing.declare());
    EXPECT_TRUE(complete.complete);
    EXPECT_EQ(growing.fills, 3);
    EXPECT_EQ(graph->read_image("accumulated")->at(0, 0, 0), 6 + growing.expected());
}

TEST_F(GraphTest, OfSeveralCountersTheLargestDecides) {
    std::uint64_t capacity = 0;
    const auto report = run([&](GraphBuilder& builder) {
        auto desc = buffer_of("list", 1);
        desc.growable = true;
        const auto list = builder.buffer(desc);
        for (const std::uint32_t part : {7u, 40u, 12u}) {
            const auto counter = builder.counter({.key = "parts", .label = "", .growth_of = list});
            builder.pass("part " + std::to_string(part), Queue::cpu)
                .writes(list)
                .counts(counter)
                .execute([=, &capacity](PassContext& p) {
                    p.add(counter, part);
                    capacity = p.capacity(list);
                });
        }
    });
    EXPECT_EQ(capacity, 50u);
    EXPECT_EQ(resource_of(report, "list").elements, 40u);
    EXPECT_EQ(report.counters.at("parts"), 59);
}

TEST_F(GraphTest, AGrowingBufferKeepsItsHistory) {
    std::uint32_t need = 2;
    std::vector<std::uint32_t> seen;
    const Declare declare = [&](GraphBuilder& builder) {
        auto desc = buffer_of("list", 4);
        desc.growable = true;
        const auto list = builder.buffer(desc);
        const auto count = builder.counter({.key = "count", .label = "", .growth_of = list});
        builder.pass("fill", Queue::cpu)
            .reads_previous(list)
            .writes(list)
            .counts(count)
            .execute([=, &seen](PassContext& p) {
                const auto before = p.previous_contents<std::uint32_t>(list);
                seen.assign(before.begin(), before.end());
                const auto now = p.elements<std::uint32_t>(list);
                p.add(count, need);
                for (std::uint32_t i = 0; i < std::min<std::uint64_t>(need, now.size()); ++i)
                    now[i] = 10 * need + i;
            });
    };
    run(declare);
    need = 8;
    run(declare);
    EXPECT_EQ(seen, (std::vector<std::uint32_t>{20, 21, 0, 0, 0, 0, 0, 0, 0, 0}));
    need = 1;
    run(declare);
    EXPECT_EQ(seen[7], 87u);
}

TEST_F(GraphTest, NothingMadeFromATruncatedBufferIsKept) {
    for (const auto growth : {Growth::rerun, Growth::next_frame}) {
        graph = std::make_unique<Graph>(*device, nullptr, nullptr);
        Growing growing;
        growing.fingerprint = "same";
        options.growth = growth;
        run(growing.declare());
        run(growing.declare());
        EXPECT_EQ(graph->read_image("total")->at(0, 0, 0), growing.expected());
        EXPECT_EQ(growing.fills, 2);
        EXPECT_EQ(growing.sums, growth == Growth::rerun ? 1 : 2);
    }
}

TEST_F(GraphTest, AFrameCancelledBeforeItsOverflowWasSeenKeepsNothingTruncated) {
    Growing growing;
    growing.fingerprint = "same";
    bool cancel = true;
    const Declare declare = [&](GraphBuilder& builder) {
        growing.declare()(builder);
        const auto last = builder.image(image_of("last"));
        builder.pass("last", Queue::cpu).writes(last).execute([&](PassContext&) {
            if (cancel) throw Cancelled();
        });
    };
    EXPECT_THROW(run(declare), Cancelled);
    cancel = false;
    run(declare);
    EXPECT_EQ(graph->read_image("total")->at(0, 0, 0), growing.expected());
}

TEST_F(GraphTest, SkippedPassesKeepTheirCounts) {
    Growing growing;
    growing.fingerprint = "same";
    run(growing.declare());
    const auto report = run(growing.declare());
    EXPECT_EQ(pass_of(report, "fill").slices, 0);
    EXPECT_EQ(report.counters.at("list.count"), 100);
    EXPECT_EQ(resource_of(report, "list").elements, 100u);
}

TEST_F(GraphTest, ABufferThatNeverHasEnoughIsAnError) {
    EXPECT_THROW(run([](GraphBuilder& builder) {
                     auto desc = buffer_of("greedy", 1);
                     desc.growable = true;
                     const auto list = builder.buffer(desc);
                     const auto count = builder.counter({.key = "count", .label = "", .growth_of = list});
                     builder.pass("add", Queue::cpu).writes(list).counts(count).execute([=](PassContext& p) {
                         p.add(count, static_cast<std::uint32_t>(p.capacity(list)) + 1);
                     });
                 }),
                 Error);
}

}  // namespace
}  // namespace ir::graph
