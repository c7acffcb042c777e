#include "renderers/core/error.h"
#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {
namespace {

/// A method that accumulates numbers over frames and explains one of them: "why" holds the picked number's
/// value, its square by way of a scratch buffer, and how often anything ran.
class ExplainTest : public GraphTest {
  protected:
    ExplainTest() {
        method.description.id = "test";
        method.description.outputs = {
            {.key = "sum", .label = "sum", .kind = OutputKind::table},
            {.key = "why", .label = "why", .kind = OutputKind::table, .explains = true}};
        method.setup = [this](GraphBuilder& builder, const Settings&) { declare(builder); };
        options.wanted = {"why"};
        inputs.inspection.x = 2;
        inputs.inspection.y = 0;
    }

    virtual void declare(GraphBuilder& builder) {
        auto why_desc = buffer_of("why", why_elements);
        why_desc.growable = true;
        const auto sum = builder.buffer(buffer_of("sum", 8)),
                   scratch = builder.buffer(buffer_of("scratch", 1)),
                   other = builder.buffer(buffer_of("other", 8)), why = builder.buffer(why_desc);
        const auto requested =
            builder.counter({.key = "why.requested", .label = "Requested", .growth_of = why});
        const auto items = builder.counter({.key = "items", .label = "Items"});
        builder.pass("add", Queue::cpu)
            .reads_previous(sum)
            .writes(sum)
            .counts(items)
            .execute([this, sum, items](PassContext& p) {
                ++adds;
                const auto before = p.previous_contents<std::uint32_t>(sum);
                for (std::size_t i = 0; i < 8; ++i)
                    p.elements<std::uint32_t>(sum)[i] = before[i] + std::uint32_t(i) + 1;
                p.add(items, 8);
            });
        builder.pass("other", Queue::cpu).reads(sum).writes(other).execute([sum, other](PassContext& p) {
            for (std::size_t i = 0; i < 8; ++i)
                p.elements<std::uint32_t>(other)[i] = 100 * p.elements<std::uint32_t>(sum)[i];
        });
        builder.pass("square", Queue::cpu).reads(sum).writes(scratch).execute([sum, scratch](PassContext& p) {
            const auto value = p.elements<std::uint32_t>(sum)[std::size_t(p.inputs().inspection.x)];
            p.elements<std::uint32_t>(scratch)[0] = value * value;
        });
        builder.pass("explain", Queue::cpu)
            .reads(sum, scratch)
            .reads_previous(sum)
            .writes(why)
            .counts(requested)
            .execute([this, sum, scratch, why, requested](PassContext& p) {
                ++explanations;
                if (throws) throw Error("no explanation");
                const auto x = std::size_t(p.inputs().inspection.x);
                const std::uint32_t values[] = {
                    p.elements<std::uint32_t>(sum)[x], p.elements<std::uint32_t>(scratch)[0],
                    p.previous_contents<std::uint32_t>(sum)[x], std::uint32_t(p.has_previous())};
                const auto to = p.elements<std::uint32_t>(why);
                p.add(requested, 4);
                for (std::size_t i = 0; i < std::min<std::size_t>(4, to.size()); ++i) to[i] = values[i];
            });
    }

    FrameReport run() {
        inputs.frame = frame;
        auto report = graph->run(method, {}, inputs, options);
        if (report.complete) ++frame;
        return report;
    }
    bool explain(int x) {
        inputs.inspection.x = x;
        return graph->explain(method, {}, inputs, options);
    }
    std::vector<std::uint32_t> why() const {
        auto values = elements("why");
        values.resize(4);
        return values;
    }
    /// What a graph that never explained anything else says of x after `frames` frames.
    std::vector<std::uint32_t> fresh(int x, int frames) {
        Graph other(*device, nullptr, nullptr);
        auto requested = inputs;
        requested.inspection.x = x;
        for (requested.frame = 0; requested.frame < frames; ++requested.frame)
            other.run(method, {}, requested, options);
        auto values = as<std::uint32_t>(other.read_buffer("why").value());
        values.resize(4);
        return values;
    }

    Method method;
    std::uint64_t why_elements = 4;
    int adds = 0, explanations = 0;
    bool throws = false;
};

TEST_F(ExplainTest, ExplanationsAreCulledUnlessTheyAreWanted) {
    options.wanted.clear();
    const auto report = run();
    EXPECT_TRUE(pass_of(report, "explain").culled);
    EXPECT_TRUE(pass_of(report, "square").culled);
    EXPECT_FALSE(resource_of(report, "why").available);
    EXPECT_TRUE(resource_of(report, "why").explains);
    EXPECT_FALSE(resource_of(report, "sum").explains);
    EXPECT_EQ(explanations, 0);
}

TEST_F(ExplainTest, AnotherPixelGivesWhatAFreshRunGives) {
    run();
    run();
    const auto sum = elements("sum");
    for (const int x : {5, 0, 7}) {
        ASSERT_TRUE(explain(x));
        EXPECT_EQ(why(), fresh(x, 2)) << x;
        EXPECT_EQ(why()[0], sum[std::size_t(x)]);
    }
    EXPECT_EQ(elements("sum"), sum);
}

TEST_F(ExplainTest, RunsNothingElse) {
    run();
    const int adds_before = adds;
    ASSERT_TRUE(explain(3));
    EXPECT_EQ(adds, adds_before);
    const auto& report = graph->last_report();
    EXPECT_EQ(report.frame, 0);
    EXPECT_FALSE(pass_of(report, "add").culled);
    EXPECT_EQ(pass_of(report, "add").slices, 1);
    EXPECT_EQ(report.counters.at("items"), 8);
    EXPECT_EQ(report.counters.at("why.requested"), 4);
    EXPECT_EQ(pass_of(report, "add").writes, std::vector<std::string>{"sum"});
}

TEST_F(ExplainTest, LeavesTheHistoryAlone) {
    run();
    run();
    for (int x = 0; x < 8; ++x) ASSERT_TRUE(explain(x));
    run();
    for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(elements("sum")[i], 3 * (i + 1));
    EXPECT_EQ(why(), fresh(7, 3));
}

TEST_F(ExplainTest, ComputesWhatWasCulled) {
    options.wanted.clear();
    run();
    const auto sum = elements("sum");
    options.wanted = {"other"};
    ASSERT_TRUE(explain(1));
    EXPECT_TRUE(resource_of(graph->last_report(), "other").available);
    EXPECT_FALSE(resource_of(graph->last_report(), "why").available);
    EXPECT_EQ(explanations, 0);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(elements("other")[i], 100 * sum[i]);
    EXPECT_EQ(adds, 1);
}

TEST_F(ExplainTest, GrowsWhatItFills) {
    why_elements = 1;
    run();
    why_elements = 2;  // another estimate: the learned capacity is forgotten
    const int adds_before = adds, explanations_before = explanations;
    ASSERT_TRUE(explain(6));
    EXPECT_EQ(explanations, explanations_before + 2);
    EXPECT_EQ(adds, adds_before);
    EXPECT_EQ(why(), fresh(6, 1));
}

TEST_F(ExplainTest, SaysNoWithoutACommittedFrame) {
    EXPECT_FALSE(explain(1));
    run();
    graph->reset_history();
    EXPECT_FALSE(explain(1));
    run();
    EXPECT_TRUE(explain(1));
    inputs.view.width = 5;
    EXPECT_FALSE(explain(1));
}

TEST_F(ExplainTest, SaysNoAfterAFrameThatFailed) {
    run();
    throws = true;
    EXPECT_THROW(run(), Error);
    throws = false;
    EXPECT_FALSE(explain(1));
}

TEST_F(ExplainTest, AFailureLeavesTheResultAndNoExplanation) {
    run();
    const auto sum = elements("sum");
    throws = true;
    EXPECT_THROW(explain(3), Error);
    EXPECT_EQ(elements("sum"), sum);
    EXPECT_FALSE(graph->read_buffer("why").has_value());
    EXPECT_FALSE(resource_of(graph->last_report(), "why").available);
    EXPECT_TRUE(resource_of(graph->last_report(), "sum").available);
    throws = false;
    ASSERT_TRUE(explain(3));
    EXPECT_EQ(why(), fresh(3, 1));
}

TEST_F(ExplainTest, CanBeCancelled) {
    run();
    CancelToken cancel;
    cancel.cancel();
    options.cancel = &cancel;
    EXPECT_THROW(explain(3), Cancelled);
    cancel.reset();
    EXPECT_TRUE(explain(3));
    EXPECT_EQ(why(), fresh(3, 1));
}

/// As batches do: one buffer, written for each part of the work in turn.
class OverwritingTest : public ExplainTest {
  protected:
    void declare(GraphBuilder& builder) override {
        const auto part = builder.buffer(buffer_of("part", 1)), sum = builder.buffer(buffer_of("sum", 1)),
                   why = builder.buffer(buffer_of("why", 2));
        for (std::uint32_t batch = 0; batch < 2; ++batch) {
            const auto name = [&](const char* text) { return text + std::to_string(batch); };
            builder.pass(name("part"), Queue::cpu).writes(part).execute([part, batch](PassContext& p) {
                p.elements<std::uint32_t>(part)[0] = 10 + batch;
            });
            builder.pass(name("add"), Queue::cpu)
                .reads(part)
                .writes(sum)
                .execute([part, sum](PassContext& p) {
                    p.elements<std::uint32_t>(sum)[0] += p.elements<std::uint32_t>(part)[0];
                });
            builder.pass(name("why"), Queue::cpu).reads(part).writes(why).execute([=](PassContext& p) {
                p.elements<std::uint32_t>(why)[batch] =
                    p.elements<std::uint32_t>(part)[0] * std::uint32_t(p.inputs().inspection.x);
            });
        }
    }
};

TEST_F(OverwritingTest, SaysNoAndChangesNothingWhereItsInputIsOverwritten) {
    run();
    const auto report = graph->last_report();
    EXPECT_EQ(elements("why"), (std::vector<std::uint32_t>{20, 22}));
    EXPECT_FALSE(explain(3));
    EXPECT_EQ(elements("why"), (std::vector<std::uint32_t>{20, 22}));
    EXPECT_EQ(elements("sum"), std::vector<std::uint32_t>{21});
    EXPECT_EQ(graph->last_report().resources.size(), report.resources.size());
}

/// The pass of the result also writes the explanation.
class EntangledTest : public ExplainTest {
  protected:
    void declare(GraphBuilder& builder) override {
        const auto sum = builder.buffer(buffer_of("sum", 1)), why = builder.buffer(buffer_of("why", 1));
        builder.pass("both", Queue::cpu).writes(sum, why).execute([=](PassContext& p) {
            p.elements<std::uint32_t>(sum)[0] = 1;
            p.elements<std::uint32_t>(why)[0] = std::uint32_t(p.inputs().inspection.x);
        });
    }
};

TEST_F(EntangledTest, SaysNoWhereTheResultsOwnPassExplains) {
    run();
    EXPECT_FALSE(explain(3));
    EXPECT_EQ(elements("why"), std::vector<std::uint32_t>{2});
}

}  // namespace
}  // namespace ir::graph
