#include <thread>

#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

struct Sliced {
    std::int64_t items = 1000, first_slice = 10;
    std::vector<Slice> slices;
    std::function<void(Slice)> work = [](Slice) {};

    Declare declare() {
        return [this](GraphBuilder& builder) {
            const auto sum = builder.image(image_of("sum"));
            builder.pass("long", Queue::cpu)
                .reads_previous(sum)
                .writes(sum)
                .execute_sliced(
                    items,
                    [=, this](PassContext& p, Slice slice) {
                        slices.push_back(slice);
                        const auto now = p.pixels<float>(sum), before = p.previous_contents<float>(sum);
                        if (slice.first) now[0] = before[0];
                        now[0] += static_cast<float>(slice.end - slice.begin);
                        work(slice);
                    },
                    first_slice);
        };
    }
    void expect_partition() const {
        ASSERT_FALSE(slices.empty());
        std::int64_t at = 0;
        for (std::size_t i = 0; i < slices.size(); ++i) {
            EXPECT_EQ(slices[i].begin, at);
            EXPECT_EQ(slices[i].first, i == 0);
            EXPECT_EQ(slices[i].last, i + 1 == slices.size());
            at = slices[i].end;
        }
        EXPECT_EQ(at, items);
    }
};

/// So slow that the work is divided.
void rest(Slice slice) {
    std::this_thread::sleep_for(std::chrono::microseconds(100 * (slice.end - slice.begin)));
}

TEST_F(GraphTest, SlicesPartitionTheItems) {
    for (const std::int64_t items : {0, 1, 7, 1000, 100'003})
        for (const std::int64_t first : {0, 1, 10, 5000}) {
            Sliced sliced;
            sliced.items = items;
            sliced.first_slice = first;
            const auto report = run(sliced.declare());
            sliced.expect_partition();
            EXPECT_EQ(pass_of(report, "long").slices, static_cast<int>(sliced.slices.size()));
        }
}

TEST_F(GraphTest, SlicesAreSizedByWhatTheLastOnesTook) {
    Sliced sliced;
    sliced.work = rest;
    run(sliced.declare());
    sliced.expect_partition();
    EXPECT_EQ(sliced.slices[0].end, 10);
    EXPECT_LE(sliced.slices[1].end - sliced.slices[1].begin, 300);  // which take 30 ms or more
    // The next frame knows the rate: that of a slice during which others had the processor is of no use.
    int frames = 1;
    while (sliced.slices[0].end <= 10 && ++frames < 30) {
        sliced.slices.clear();
        run(sliced.declare());
    }
    EXPECT_GT(sliced.slices[0].end, 10);
    EXPECT_LE(sliced.slices[0].end, 300);
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 1000 * frames);
}

TEST_F(GraphTest, ViewsAreServedBetweenSlicesAndProgressGrows) {
    Sliced sliced;
    sliced.work = rest;
    int served = 0;
    std::vector<double> progress;
    options.between_slices = [&] { ++served; };
    options.progress = [&](const std::string& what, double fraction) {
        EXPECT_EQ(what, "long");
        progress.push_back(fraction);
    };
    run(sliced.declare());
    EXPECT_EQ(served, static_cast<int>(sliced.slices.size()) - 1);
    EXPECT_EQ(progress.size(), sliced.slices.size());
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.back(), 1);
}

TEST_F(GraphTest, CancelTakesEffectAtTheNextSliceAndLeavesTheHistory) {
    Sliced sliced;
    CancelToken cancel;
    options.cancel = &cancel;
    sliced.work = rest;
    run(sliced.declare());
    sliced.slices.clear();
    sliced.work = [&](Slice slice) {
        rest(slice);
        if (!slice.first) cancel.cancel();
    };
    sliced.items = 100'000;
    EXPECT_THROW(run(sliced.declare()), Cancelled);
    EXPECT_EQ(sliced.slices.size(), 2u);
    cancel.reset();
    sliced.work = [](Slice) {};
    sliced.items = 1000;
    run(sliced.declare());
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 2000);
}

TEST_F(GraphTest, CancelledBeforeItBeginsNoPassRuns) {
    Sliced sliced;
    CancelToken cancel;
    cancel.cancel();
    options.cancel = &cancel;
    EXPECT_THROW(run(sliced.declare()), Cancelled);
    EXPECT_TRUE(sliced.slices.empty());
}

}  // namespace
}  // namespace ir::graph
