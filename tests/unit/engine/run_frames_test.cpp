// Reports of runs that were divided into frames.
#include "app/engine/run_frames.h"

#include <gtest/gtest.h>

#include "projects/samples.h"
#include "tests/unit/engine/egl_machine.h"

namespace ir::engine {
namespace {

class RunFrames : public testing::Test {
  protected:
    static Experiment experiment_of(const std::string& method) {
        Experiment experiment;
        experiment.scene = "builtin:cornell";
        experiment.method = method;
        experiment.width = 24;
        experiment.height = 16;
        return experiment;
    }
    static int slices(const FrameReport& report) {
        int sum = 0;
        for (const auto& pass : report.passes) sum += pass.slices;
        return sum;
    }

    Machine& machine = egl_machine();
};

TEST_F(RunFrames, OnlyWhatAddsUpHasARateOfSamples) {
    auto experiment = experiment_of("view-normals");
    experiment.frames = 3;
    Execution execution(machine, experiment);
    ASSERT_FALSE(execution.accumulates());
    const auto report = run_frames(execution, {});
    EXPECT_EQ(report.counters.count(rate_figure), 0u);
    EXPECT_EQ(report.figures.count(rate_figure), 0u);
}

TEST_F(RunFrames, ProgressTellsTheFrame) {
    auto experiment = experiment_of("view-normals");
    experiment.frames = 3;
    Execution execution(machine, experiment);
    std::vector<std::string> told;
    graph::FrameOptions options;
    options.progress = [&](const std::string& what, double) { told.push_back(what); };
    run_frames(execution, options);
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(told.front().starts_with("frame 1 of 3, ")) << told.front();
    EXPECT_TRUE(told.back().starts_with("frame 3 of 3, ")) << told.back();
}

TEST_F(RunFrames, TheNumbersAreThoseOfAllFramesThatTheSamplesWereDividedInto) {
    const auto* method = registry().reference();
    if (!method) GTEST_SKIP() << "this build has no method that accumulates";
    auto experiment = experiment_of(method->id);
    for (const auto& parameter : method->parameters)
        if (parameter.accumulates) experiment.settings[parameter.key] = std::int64_t{40};
    Execution whole(machine, experiment), divided(machine, experiment);
    const auto at_once = run_frames(whole, {});
    std::vector<FrameReport> told;
    const auto report =
        run_frames(divided, {}, {[&](const FrameReport& so_far) { told.push_back(so_far); }, 1e-9});
    ASSERT_GT(told.size(), 1u);
    EXPECT_EQ(report.counters.at("rays"), at_once.counters.at("rays"));
    EXPECT_EQ(report.figures.at("rays"), at_once.figures.at("rays"));
    told.push_back(report);
    for (std::size_t i = 1; i < told.size(); ++i) {
        EXPECT_GT(told[i].counters.at("rays"), told[i - 1].counters.at("rays"));
        EXPECT_GT(slices(told[i]), slices(told[i - 1]));
        for (std::size_t p = 0; p < report.passes.size(); ++p)
            EXPECT_GE(told[i].passes[p].cpu_ms, told[i - 1].passes[p].cpu_ms) << told[i].passes[p].name;
    }
}

}  // namespace
}  // namespace ir::engine
