// Reports of runs that were divided into frames.
#include "app/engine/run_frames.h"

#include <gtest/gtest.h>

#include "projects/samples.h"

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

    Machine machine{{"egl", {}, false, 0}};
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

}  // namespace
}  // namespace ir::engine
