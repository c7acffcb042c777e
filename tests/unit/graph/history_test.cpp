#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// A running sum over committed frames: each frame adds 1 to what the last one left.
struct Accumulation {
    std::function<void(PassContext&)> between = [](PassContext&) {};
    std::vector<bool> had_previous;

    Declare declare() {
        return [this](GraphBuilder& builder) {
            const auto sum = builder.image(image_of("sum"));
            builder.pass("add", Queue::cpu)
                .reads_previous(sum)
                .writes(sum)
                .execute([=, this](PassContext& p) {
                    had_previous.push_back(p.has_previous());
                    const auto before = p.previous_contents<float>(sum);
                    const auto now = p.pixels<float>(sum);
                    for (std::size_t i = 0; i < now.size(); ++i) now[i] = before[i] + 1;
                    between(p);
                });
        };
    }
};

TEST_F(GraphTest, HistoryStartsWithZerosAndIsTheLastCommittedFrame) {
    Accumulation sum;
    for (int i = 1; i <= 4; ++i) {
        const auto report = run(sum.declare());
        EXPECT_TRUE(resource_of(report, "sum").is_history);
        EXPECT_EQ(graph->read_image("sum")->at(3, 2, 0), i);
    }
    EXPECT_EQ(sum.had_previous, (std::vector<bool>{false, true, true, true}));
}

TEST_F(GraphTest, FramesThatFailDoNotAdvanceTheHistory) {
    Accumulation sum;
    run(sum.declare());
    run(sum.declare());
    sum.between = [](PassContext&) { throw Cancelled(); };
    for (int i = 0; i < 2; ++i) {
        EXPECT_THROW(run(sum.declare()), Cancelled);
        EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 2) << "what is shown stays the committed frame";
    }
    EXPECT_THROW(run([](GraphBuilder&) { throw Error("no set-up"); }), Error);
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 2);
    sum.between = [](PassContext&) {};
    run(sum.declare());
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 3);
}

TEST_F(GraphTest, AFirstFrameThatFailsLeavesNoHistory) {
    Accumulation sum;
    sum.between = [](PassContext&) { throw Cancelled(); };
    EXPECT_THROW(run(sum.declare()), Cancelled);
    sum.between = [](PassContext&) {};
    run(sum.declare());
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 1);
    EXPECT_FALSE(sum.had_previous.back());
}

TEST_F(GraphTest, AnotherShapeDropsTheHistory) {
    Accumulation sum;
    run(sum.declare());
    run(sum.declare());
    inputs.view.width = 9;
    run(sum.declare());
    EXPECT_FALSE(sum.had_previous.back());
    EXPECT_EQ(graph->read_image("sum")->at(8, 2, 0), 1);
}

TEST_F(GraphTest, ResetForgetsTheHistory) {
    Accumulation sum;
    run(sum.declare());
    run(sum.declare());
    graph->reset_history();
    run(sum.declare());
    EXPECT_FALSE(sum.had_previous.back());
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 1);
    run(sum.declare());
    EXPECT_EQ(graph->read_image("sum")->at(0, 0, 0), 2);
}

TEST_F(GraphTest, ALaterPassMayReadTheHistoryToo) {
    std::vector<float> seen;
    const Declare declare = [&](GraphBuilder& builder) {
        const auto number = builder.image(image_of("number")), copy = builder.image(image_of("copy"));
        const int frame_number = builder.inputs().frame;
        builder.pass("write", Queue::cpu).writes(number).execute([=](PassContext& p) {
            for (float& x : p.pixels<float>(number)) x = 10.0f + static_cast<float>(frame_number);
        });
        builder.pass("look", Queue::cpu)
            .reads(number)
            .reads_previous(number)
            .writes(copy)
            .execute([&seen, number](PassContext& p) {
                seen.push_back(p.pixels<float>(number)[0]);
                seen.push_back(p.previous_contents<float>(number)[0]);
            });
    };
    for (int i = 0; i < 3; ++i) run(declare);
    EXPECT_EQ(seen, (std::vector<float>{10, 0, 11, 10, 12, 11}));
}

TEST_F(GraphTest, ContentsWithHistoryAreMadeInEachFrameWhateverTheirFingerprint) {
    std::vector<float> seen;
    std::string fingerprint;
    const Declare declare = [&](GraphBuilder& builder) {
        auto desc = image_of("number");
        desc.fingerprint = fingerprint;
        const auto number = builder.image(desc), copy = builder.image(image_of("copy"));
        const float value = fingerprint == "one" ? 1 : 2;
        builder.pass("write", Queue::cpu).writes(number).execute([=](PassContext& p) {
            for (float& x : p.pixels<float>(number)) x = value;
        });
        builder.pass("look", Queue::cpu)
            .reads_previous(number)
            .writes(copy)
            .execute(
                [&seen, number](PassContext& p) { seen.push_back(p.previous_contents<float>(number)[0]); });
    };
    for (const char* name : {"one", "two", "one", "one", "two"}) {
        fingerprint = name;
        run(declare);
    }
    EXPECT_EQ(seen, (std::vector<float>{0, 1, 2, 1, 1}));
    EXPECT_EQ(graph->read_image("number")->at(0, 0, 0), 2);
}

TEST_F(GraphTest, BuffersHaveHistoryToo) {
    const Declare declare = [](GraphBuilder& builder) {
        const auto sums = builder.buffer(buffer_of("sums", 5));
        builder.pass("add", Queue::cpu).reads_previous(sums).writes(sums).execute([=](PassContext& p) {
            const auto before = p.previous_contents<std::uint32_t>(sums);
            const auto now = p.elements<std::uint32_t>(sums);
            for (std::size_t i = 0; i < 5; ++i) now[i] = before[i] + static_cast<std::uint32_t>(i);
        });
    };
    for (int i = 0; i < 3; ++i) run(declare);
    EXPECT_EQ(elements("sums"), (std::vector<std::uint32_t>{0, 3, 6, 9, 12}));
}

}  // namespace
}  // namespace ir::graph
