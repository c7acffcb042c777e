// What stands still is kept: another camera builds nothing that does not see it.
#include <gtest/gtest.h>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"

namespace ir::engine {
namespace {

class StandsStill : public testing::Test {
  protected:
    Experiment experiment_of(const MethodDescription& method) const {
        Experiment experiment;
        experiment.scene = "builtin:cornell";
        experiment.method = method.id;
        experiment.width = 48;
        experiment.height = 36;
        experiment.settings = coarse(method.parameters, defaults(method.parameters));
        return experiment;
    }
    static scene::Camera aside(scene::Camera camera) {
        camera.eye += glm::vec3(0.05f, 0.02f, 0);
        return camera;
    }
    static std::vector<std::string> built(const FrameReport& report) {
        std::vector<std::string> names;
        for (const auto& pass : report.passes)
            if (pass.is_kept && pass.slices > 0) names.push_back(pass.name);
        return names;
    }
    static bool keeps(const FrameReport& report, const std::string& name) {
        return std::any_of(report.passes.begin(), report.passes.end(),
                           [&](const auto& pass) { return pass.name == name && pass.is_kept; });
    }
    Machine machine{{"egl", {}, false, 0}};
};

TEST_F(StandsStill, ACameraThatMovesBuildsNothingThatDoesNotSeeIt) {
    for (const auto* method : registry().methods()) {
        auto experiment = experiment_of(*method);
        Execution execution(machine, experiment);
        EXPECT_FALSE(built(execution.run_frame({})).empty()) << method->id;
        experiment.camera = aside(execution.camera());
        execution.update(experiment);
        EXPECT_EQ(built(execution.run_frame({})), std::vector<std::string>()) << method->id;
        Execution fresh(machine, experiment);
        fresh.run_frame({});
        EXPECT_EQ(main_result(execution).pixels, main_result(fresh).pixels) << method->id;
    }
}

TEST_F(StandsStill, MapsDependOnTheSceneAlone) {
    Machine machine{{.backend = "egl", .device = {}, .processor = Processor::gl}};  // the host keeps no maps
    for (const char* id : {"ldm-ao", "ldm-indirect"}) {
        auto experiment = experiment_of(registry().at(id));
        Execution execution(machine, experiment);
        const auto first = execution.run_frame({});
        EXPECT_TRUE(keeps(first, "build maps")) << id;
        experiment.camera = aside(execution.camera());
        experiment.replace_lights = true;
        experiment.lights = execution.world().lights;
        for (auto& light : experiment.lights) light.position.x += 0.1f;
        execution.update(experiment);
        const auto moved = execution.run_frame({});
        for (const auto& name : built(moved)) {
            EXPECT_NE(name, "build maps") << id;
            EXPECT_NE(name, "upload scene") << id;
        }
        EXPECT_EQ(moved.counters.at("ldm.fragments"), first.counters.at("ldm.fragments")) << id;
        Execution fresh(machine, experiment);
        fresh.run_frame({});
        EXPECT_EQ(main_result(execution).pixels, main_result(fresh).pixels) << id;
        experiment.settings["resolution"] = std::int64_t{40};
        execution.update(experiment);
        const auto finer = built(execution.run_frame({}));
        EXPECT_NE(std::find(finer.begin(), finer.end(), "build maps"), finer.end()) << id;
    }
}

/// A benchmark measures all of it.
TEST_F(StandsStill, RebuildingBuildsAll) {
    Execution execution(machine, experiment_of(registry().at("ldm-ao")));
    const auto first = built(execution.run_frame({}));
    graph::FrameOptions options;
    options.rebuild = true;
    EXPECT_EQ(built(execution.run_frame(options)), first);
}

}  // namespace
}  // namespace ir::engine
