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

/// A list that a pass fills, another changes and a third lengthens; "late" is written by the last.
class ListStepsTest : public GraphTest {
  protected:
    ListStepsTest() {
        method.description.id = "test";
        method.setup = [this](GraphBuilder& builder, const Settings&) { declare(builder); };
        options.versions = {"list", "late"};
    }

    void declare(GraphBuilder& builder) {
        auto list_desc = buffer_of("list", 4);
        list_desc.growable = true;
        auto late_desc = buffer_of("late", 2);
        if (is_kept) list_desc.fingerprint = late_desc.fingerprint = "same";
        const auto list = builder.buffer(list_desc), late = builder.buffer(late_desc);
        const auto count = builder.counter({.key = "list.count", .label = "Count", .growth_of = list});
        builder.pass("fill", Queue::cpu).writes(list).counts(count).execute([=, this](PassContext& p) {
            ++fills;
            for (std::uint32_t i = 0; i < 3; ++i) p.elements<std::uint32_t>(list)[i] = i + 1;
            p.add(count, 3);
        });
        builder.pass("double", Queue::cpu).reads(list).writes(list).execute([=](PassContext& p) {
            for (auto& x : p.elements<std::uint32_t>(list)) x *= 2;
        });
        builder.pass("add", Queue::cpu)
            .reads(list)
            .writes(list, late)
            .counts(count)
            .execute([=](PassContext& p) {
                p.elements<std::uint32_t>(list)[3] = 50;
                p.elements<std::uint32_t>(late)[1] = 7;
                p.add(count, 1);
            });
    }

    FrameReport run() {
        inputs.frame = frame;
        auto report = graph->run(method, {}, inputs, options);
        if (report.complete) ++frame;
        return report;
    }
    std::optional<std::vector<std::uint32_t>> after(const std::string& pass,
                                                    const std::string& key = "list") {
        const auto then = graph->read_buffer_after(pass, key);
        if (!then) return {};
        EXPECT_EQ(then->elements * 4, then->bytes.size());
        return as<std::uint32_t>(then->bytes);
    }
    using Numbers = std::vector<std::uint32_t>;

    Method method;
    bool is_kept = false;
    int fills = 0;
};

TEST_F(ListStepsTest, AListIsSeenAsEachPassLeftIt) {
    run();
    EXPECT_EQ(after("fill"), (Numbers{1, 2, 3})) << "as many as were counted by then";
    EXPECT_EQ(after("double"), (Numbers{2, 4, 6}));
    EXPECT_EQ(after("add"), (Numbers{2, 4, 6, 50}));
    EXPECT_EQ(after("double", "late"), std::nullopt) << "is not written yet";
    EXPECT_EQ(after("add", "late"), (Numbers{0, 7}));
    EXPECT_EQ(after("no such"), std::nullopt);
    EXPECT_EQ(after("fill", "no such"), std::nullopt);
    const auto part = graph->read_buffer_after("double", "list", 8);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->elements, 3u);
    EXPECT_EQ(as<std::uint32_t>(part->bytes), (Numbers{2, 4}));
    options.versions.clear();
    run();
    EXPECT_EQ(after("double"), std::nullopt) << "they are those of the last frame";
    EXPECT_EQ(after("add"), (Numbers{2, 4, 6, 50}));
}

TEST_F(ListStepsTest, ItIsDrawnFromTheDevice) {
    run();
    for (int look = 0; look < 2; ++look) {
        const auto then = graph->device_buffer_after("double", "list");
        ASSERT_TRUE(then);
        EXPECT_EQ(then->elements, 3u);
        EXPECT_EQ(then->desc.text.key, "list");
        std::vector<std::byte> bytes(12);
        device->read_buffer(then->name, 0, bytes);
        EXPECT_EQ(as<std::uint32_t>(bytes), (Numbers{2, 4, 6}));
    }
    EXPECT_EQ(graph->device_buffer_after("add", "list")->name, graph->device_buffer("list")->name);
    EXPECT_FALSE(graph->device_buffer_after("fill", "late"));
}  // which fails where anything stays on the device

TEST_F(ListStepsTest, PassesThatWereSkippedRunForTheirVersionsAlone) {
    is_kept = true;
    options.versions.clear();
    run();
    run();
    EXPECT_EQ(fills, 1);
    options.versions = {"late"};  // one pass alone writes it
    run();
    EXPECT_EQ(fills, 1);
    options.versions = {"list"};
    run();
    EXPECT_EQ(fills, 2);
    EXPECT_EQ(after("fill"), (Numbers{1, 2, 3}));
}

TEST_F(ListStepsTest, WhatTakesTooMuchIsNotKeptAndSaid) {
    options.versions_limit = 16;
    const auto report = run();
    EXPECT_EQ(after("fill"), (Numbers{1, 2, 3}));
    EXPECT_EQ(after("double"), std::nullopt) << "not what the pass before left";
    ASSERT_EQ(report.messages.size(), 1u);
    EXPECT_EQ(report.messages[0].text, "what 'double' left of 'list' is not kept: steps may take 16 B");
}

TEST_F(ListStepsTest, AnExplanationHasStepsOfItsOwn) {
    method.description.outputs = {
        {.key = "why", .label = "Why", .kind = OutputKind::table, .explains = true}};
    method.setup = [](GraphBuilder& builder, const Settings&) {
        const auto sum = builder.buffer(buffer_of("sum", 1)),
                   why = builder.output("why", buffer_of("why", 1));
        builder.pass("add", Queue::cpu).writes(sum).execute([sum](PassContext& p) {
            p.elements<std::uint32_t>(sum)[0] = 5;
        });
        builder.pass("look", Queue::cpu).reads(sum).writes(why).execute([=](PassContext& p) {
            p.elements<std::uint32_t>(why)[0] =
                p.elements<std::uint32_t>(sum)[0] + std::uint32_t(p.inputs().inspection.x);
        });
        builder.pass("double", Queue::cpu).reads(why).writes(why).execute([=](PassContext& p) {
            p.elements<std::uint32_t>(why)[0] *= 2;
        });
    };
    options.wanted = {"sum", "why"};
    options.versions = {"why"};
    inputs.inspection.x = 1;
    run();
    EXPECT_EQ(after("look", "why"), Numbers{6});
    inputs.inspection.x = 2;
    ASSERT_TRUE(graph->explain(method, {}, inputs, options));
    EXPECT_EQ(after("look", "why"), Numbers{7}) << "not that of the frame";
    EXPECT_EQ(after("double", "why"), Numbers{14});
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
