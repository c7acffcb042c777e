#include <tuple>

#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// "shade" is painted, doubled and lifted by three passes; "seen" copies what is there between the last two.
class StepsTest : public GraphTest {
  protected:
    StepsTest() {
        method.description.id = "test";
        method.setup = [this](GraphBuilder& builder, const Settings&) { declare(builder); };
    }

    void declare(GraphBuilder& builder) {
        auto shade_desc = image_of("shade");
        if (is_kept) shade_desc.fingerprint = "same";
        const auto shade = builder.image(shade_desc), seen = builder.image(image_of("seen"));
        auto small_desc = image_of("small");
        small_desc.extent = Extent::fixed(2, 2);
        const auto small = builder.image(small_desc);
        builder.pass("paint", Queue::cpu).writes(shade).execute([this, shade](PassContext& p) {
            ++paints;
            for (std::size_t i = 0; i < 12; ++i) p.pixels<float>(shade)[i] = float(i);
        });
        builder.pass("double", Queue::cpu).reads(shade).writes(shade).execute([shade](PassContext& p) {
            for (auto& x : p.pixels<float>(shade)) x *= 2;
        });
        builder.pass("see", Queue::cpu).reads(shade).writes(seen, small).execute([=](PassContext& p) {
            for (std::size_t i = 0; i < 12; ++i) p.pixels<float>(seen)[i] = p.pixels<float>(shade)[i];
            for (auto& x : p.pixels<float>(small)) x = 9;
        });
        builder.pass("lift", Queue::cpu).reads(shade).writes(shade).execute([shade](PassContext& p) {
            for (auto& x : p.pixels<float>(shade)) x += 100;
        });
    }

    FrameReport run() {
        inputs.frame = frame;
        auto report = graph->run(method, {}, inputs, options);
        if (report.complete) ++frame;
        return report;
    }
    std::optional<float> after(const std::string& pass, const std::string& key = "shade") {
        const auto image = graph->read_after(pass, key);
        return image ? std::optional(image->at(1, 1)) : std::nullopt;
    }

    Method method;
    bool is_kept = false;
    int paints = 0;
};

TEST_F(StepsTest, AnImageIsSeenAsEachPassLeftIt) {
    options.versions = {"shade"};
    run();
    EXPECT_EQ(after("paint"), 5.0f);
    EXPECT_EQ(after("double"), 10.0f);
    EXPECT_EQ(after("see"), 10.0f) << "which does not touch it";
    EXPECT_EQ(after("lift"), 110.0f);
    EXPECT_EQ(graph->read_image("shade")->at(1, 1), 110.0f);
    EXPECT_EQ(after("double", "seen"), std::nullopt) << "is not written yet";
    EXPECT_EQ(after("lift", "seen"), 10.0f) << "nothing overwrites it";
    EXPECT_EQ(after("no such", "shade"), std::nullopt);
    EXPECT_EQ(after("paint", "no such"), std::nullopt);
}

TEST_F(StepsTest, WhatWasNotAskedForIsThereOnlyInItsLastVersion) {
    run();
    EXPECT_EQ(after("double"), std::nullopt);
    EXPECT_EQ(after("lift"), 110.0f);
    options.versions = {"shade"};
    run();
    EXPECT_EQ(after("double"), 10.0f);
    options.versions.clear();
    run();
    EXPECT_EQ(after("double"), std::nullopt) << "they are those of the last frame";
}

TEST_F(StepsTest, PassesThatWereSkippedRunForTheirVersions) {
    is_kept = true;
    run();
    run();
    EXPECT_EQ(paints, 1);
    options.versions = {"shade"};
    run();
    EXPECT_EQ(paints, 2);
    EXPECT_EQ(after("paint"), 5.0f);
    EXPECT_EQ(after("lift"), 110.0f);
}

TEST_F(StepsTest, ATracedPixelTellsWhatPassesDidToIt) {
    options.traced = {1, 1};
    const auto report = run();
    ASSERT_EQ(report.pixel_changes.size(), 4u) << "an image with pixels of its own is not part of it";
    const std::vector<std::tuple<std::string, std::string, float>> expected{
        {"paint", "shade", 5}, {"double", "shade", 10}, {"see", "seen", 10}, {"lift", "shade", 110}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& [pass, key, values] = report.pixel_changes[i];
        EXPECT_EQ(std::tie(pass, key, values[0]), expected[i]);
    }
    options.traced.reset();
    EXPECT_TRUE(run().pixel_changes.empty());
}

TEST_F(StepsTest, OfWhatWasKeptTheLastPassTells) {
    is_kept = true;
    run();
    options.traced = {1, 1};
    const auto report = run();
    ASSERT_EQ(report.pixel_changes.size(), 2u);
    EXPECT_EQ(report.pixel_changes[0].key, "seen");
    EXPECT_EQ(report.pixel_changes[1].pass, "lift");
    EXPECT_EQ(report.pixel_changes[1].values[0], 110.0f);
}

TEST_F(StepsTest, ReadingTheFrameBeforeIsToldApart) {
    method.setup = [](GraphBuilder& builder, const Settings&) {
        const auto sum = builder.image(image_of("sum"));
        builder.pass("add", Queue::cpu).reads_previous(sum).writes(sum).execute([sum](PassContext& p) {
            for (std::size_t i = 0; i < 12; ++i)
                p.pixels<float>(sum)[i] = p.previous_contents<float>(sum)[i] + 1;
        });
    };
    const auto report = run();
    EXPECT_TRUE(pass_of(report, "add").reads.empty());
    EXPECT_EQ(pass_of(report, "add").reads_previous, std::vector<std::string>{"sum"});
    EXPECT_EQ(pass_of(report, "add").writes, std::vector<std::string>{"sum"});
}

}  // namespace
}  // namespace ir::graph
