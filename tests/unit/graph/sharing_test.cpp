#include "renderers/graph/shared_contents.h"
#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// Two graphs that share what has a fingerprint.
class SharingTest : public GraphTest {
  protected:
    SharingTest() { graph = make(); }
    void TearDown() override {
        other.reset();
        GraphTest::TearDown();
    }
    std::unique_ptr<Graph> make() { return std::make_unique<Graph>(*device, nullptr, nullptr, shared); }
    /// Counts what it makes: a growable buffer of `need` elements, an object, and their sum.
    Declare declare() {
        return [this](GraphBuilder& builder) {
            auto desc = buffer_of("data", 2);
            desc.growable = true;
            desc.fingerprint = fingerprint;
            const auto data = builder.buffer(desc);
            const auto seen = builder.image(image_of("seen"));
            const auto object = builder.object({.text = {.key = "object", .label = ""}, .fingerprint = "o"});
            const auto count = builder.counter({.key = "count", .growth_of = data});
            builder.pass("make", Queue::cpu).writes(data).counts(count).execute([=, this](PassContext& p) {
                ++made;
                p.add(count, need);
                p.elements<std::uint32_t>(data)[0] = value;
            });
            builder.pass("build", Queue::cpu).writes(object).execute([=, this](PassContext& p) {
                p.store(object, std::make_shared<int>(++built), 1000);
            });
            builder.pass("look", Queue::cpu).reads(data, object).writes(seen).execute([=](PassContext& p) {
                p.pixels<float>(seen)[0] = static_cast<float>(p.elements<std::uint32_t>(data)[0]);
            });
        };
    }
    FrameReport run_other() {
        std::swap(graph, other);
        const auto report = run(declare());
        std::swap(graph, other);
        return report;
    }

    std::shared_ptr<SharedContents> shared = std::make_shared<SharedContents>();
    std::unique_ptr<Graph> other = make();
    std::string fingerprint = "f";
    std::uint32_t value = 7, need = 2;
    int made = 0, built = 0;
};

TEST_F(SharingTest, WhatOneGraphMadeTheOtherTakes) {
    need = 9;  // it has grown by then
    run(declare());
    const int attempts = made;
    const auto report = run_other();
    EXPECT_EQ(made, attempts);
    EXPECT_EQ(built, 1);
    EXPECT_EQ(pass_of(report, "make").slices, 0);
    EXPECT_TRUE(pass_of(report, "make").is_kept);
    EXPECT_FALSE(pass_of(report, "look").is_kept);
    EXPECT_EQ(report.counters.at("count"), 9);
    EXPECT_EQ(resource_of(report, "data").elements, 9u);
    EXPECT_EQ(other->read_image("seen")->at(0, 0), 7);
}

TEST_F(SharingTest, WhatIsMadeAnewIsNotSeenByTheOther) {
    run(declare());
    run_other();
    fingerprint = "another";
    value = 8;
    run(declare());
    EXPECT_EQ(graph->read_image("seen")->at(0, 0), 8);
    fingerprint = "f";
    value = 9;  // it is not made, so it is not seen
    run_other();
    EXPECT_EQ(other->read_image("seen")->at(0, 0), 7);
    EXPECT_EQ(elements("data")[0], 8u);
    EXPECT_EQ(made, 2);
}

/// Nor is what stood there before, by its old name.
TEST_F(SharingTest, WhatWasWrittenOverIsNotTaken) {
    run(declare());
    fingerprint = "another";
    value = 8;
    run(declare());
    fingerprint = "f";
    value = 7;
    run_other();
    EXPECT_EQ(made, 3);
    EXPECT_EQ(other->read_image("seen")->at(0, 0), 7);
}

TEST_F(SharingTest, ItLastsAsLongAsOneGraphKeepsIt) {
    run(declare());
    run_other();
    graph = make();
    run(declare());
    EXPECT_EQ(made, 1) << "the other one has it";
    graph.reset();
    other.reset();
    EXPECT_EQ(counts.buffers, 0);
    graph = make();
    run(declare());
    EXPECT_EQ(made, 2);
}

TEST_F(SharingTest, RebuildingTakesNothingFromOthers) {
    run(declare());
    options.rebuild = true;
    run_other();
    EXPECT_EQ(made, 2);
    EXPECT_EQ(built, 2);
}

}  // namespace
}  // namespace ir::graph
