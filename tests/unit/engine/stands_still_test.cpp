// What stands still is kept: another camera builds nothing that does not see it.
#include <gtest/gtest.h>

#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "tests/unit/engine/egl_machine.h"

namespace ir::engine {
namespace {

class StandsStill : public testing::Test {
  protected:
    Experiment experiment_of(const MethodDescription& method) const {
        Experiment experiment;
        experiment.scene = "builtin:cornell";
        experiment.method = method.id;
        experiment.width = 32;
        experiment.height = 24;
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
    static bool builds(const FrameReport& report, const std::string& name) {
        const auto names = built(report);
        return std::find(names.begin(), names.end(), name) != names.end();
    }
    static bool keeps(const FrameReport& report, const std::string& name) {
        return std::any_of(report.passes.begin(), report.passes.end(),
                           [&](const auto& pass) { return pass.name == name && pass.is_kept; });
    }
    /// Surfels are of equal size in the picture.
    static bool sees_the_camera(const std::string& pass) {
        return pass.find("surfels") != std::string::npos || pass.find("triangles") != std::string::npos ||
               pass == "splat" || pass.starts_with("exact rays");
    }
    static void move_lights(Experiment& experiment, const Execution& execution) {
        experiment.replace_lights = true;
        experiment.lights = execution.world().lights;
        for (auto& light : experiment.lights) light.position.x += 0.1f;
    }
    static void expect_as_anew(Machine& machine, const Execution& execution, const Experiment& experiment,
                               const std::string& what) {
        Execution fresh(machine, experiment);
        fresh.run_frame({});
        EXPECT_EQ(main_result(execution).pixels, main_result(fresh).pixels) << what;
    }
    /// Another value than the one that it has.
    static Value other(const ParameterDescription& parameter, const Value& value) {
        if (parameter.type == ParameterType::toggle) return !std::get<bool>(value);
        if (parameter.type == ParameterType::choice) {
            const auto& choices = parameter.choices;
            return std::get<std::string>(value) == choices[0].key ? choices[1].key : choices[0].key;
        }
        if (parameter.type == ParameterType::integer) {
            const auto number = std::get<std::int64_t>(value);
            return static_cast<double>(number) < parameter.hard.max ? number + 1 : number - 1;
        }
        const double number = std::get<double>(value);
        return number == 0 ? std::min(0.5, parameter.hard.max) : std::max(0.5 * number, parameter.hard.min);
    }
    Machine& machine = egl_machine();
};

TEST_F(StandsStill, ACameraThatMovesBuildsNothingThatDoesNotSeeIt) {
    for (const auto* method : registry().methods()) {
        auto experiment = experiment_of(*method);
        Execution execution(machine, experiment);
        const auto first = execution.run_frame({});
        EXPECT_TRUE(std::any_of(first.passes.begin(), first.passes.end(), [](const auto& pass) {
            return pass.is_kept;
        })) << method->id;
        experiment.camera = aside(execution.camera());
        execution.update(experiment);
        for (const auto& name : built(execution.run_frame({})))
            EXPECT_TRUE(sees_the_camera(name)) << method->id << ": " << name;
        expect_as_anew(machine, execution, experiment, method->id);
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
        move_lights(experiment, execution);
        execution.update(experiment);
        const auto moved = execution.run_frame({});
        for (const auto& name : built(moved)) {
            EXPECT_NE(name, "build maps") << id;
            EXPECT_NE(name, "upload scene") << id;
        }
        EXPECT_EQ(moved.counters.at("ldm.fragments"), first.counters.at("ldm.fragments")) << id;
        expect_as_anew(machine, execution, experiment, id);
        experiment.settings["resolution"] = std::int64_t{40};
        execution.update(experiment);
        const auto finer = built(execution.run_frame({}));
        EXPECT_NE(std::find(finer.begin(), finer.end(), "build maps"), finer.end()) << id;
    }
}

TEST_F(StandsStill, SurfelsAndWhatRaysMeetDependOnNoLight) {
    for (const bool visibility : {true, false}) {
        auto experiment = experiment_of(registry().at("deep-screen-space"));
        experiment.settings["paths"] = std::string("indirect");
        experiment.settings["visibility"] = visibility;
        experiment.settings["placement"] = std::string(visibility ? "systematic" : "random");
        Execution execution(machine, experiment);
        const auto first = execution.run_frame({});
        EXPECT_TRUE(keeps(first, visibility ? "place surfels" : "pack surfels"));
        if (!visibility) {
            EXPECT_TRUE(keeps(first, "cull triangles"));
        }
        EXPECT_EQ(keeps(first, "splat"), visibility);
        move_lights(experiment, execution);
        execution.update(experiment);
        const auto moved = execution.run_frame({});
        for (const auto& name : built(moved)) EXPECT_FALSE(sees_the_camera(name)) << name;
        EXPECT_EQ(moved.counters.at("surfels.kept"), first.counters.at("surfels.kept"));
        expect_as_anew(machine, execution, experiment, "lights");
    }
}

TEST_F(StandsStill, SourcesWithAnExtentStayUntilLightsChange) {
    Machine host{{.backend = "egl", .device = {}, .processor = Processor::host}};
    auto experiment = experiment_of(registry().at("ssdo"));  // the Cornell box has a lamp that is a mesh
    Execution execution(host, experiment);
    EXPECT_TRUE(builds(execution.run_frame({}), "light sources"));
    experiment.camera = aside(execution.camera());
    execution.update(experiment);
    EXPECT_FALSE(builds(execution.run_frame({}), "light sources"));
    expect_as_anew(host, execution, experiment, "camera");
    move_lights(experiment, execution);
    execution.update(experiment);
    EXPECT_TRUE(builds(execution.run_frame({}), "light sources"));
    expect_as_anew(host, execution, experiment, "lights");
}

TEST_F(StandsStill, SurfelsStayWhileTheReceiversSamplesChange) {
    auto experiment = experiment_of(registry().at("deep-screen-space"));
    experiment.settings["level0"] = std::string("discs");
    Execution execution(machine, experiment);
    execution.run_frame({});
    EXPECT_EQ(built(execution.run_frame({})), std::vector<std::string>());
    experiment.settings["blur_radius"] = std::int64_t{1};
    execution.update(experiment);
    EXPECT_EQ(built(execution.run_frame({})), std::vector<std::string>());
    experiment.settings["samples"] = std::int64_t{3};
    execution.update(experiment);
    EXPECT_EQ(built(execution.run_frame({})), std::vector<std::string>{"splat"});
    expect_as_anew(machine, execution, experiment, "samples");
    experiment.seed = 7;
    execution.update(experiment);
    EXPECT_TRUE(builds(execution.run_frame({}), "place surfels"));
    expect_as_anew(machine, execution, experiment, "seed");
}

TEST_F(StandsStill, ASizeBeyondTheDeviceIsRefusedAndThePictureStays) {
    const auto experiment = experiment_of(registry().at("hbao"));
    Execution execution(machine, experiment);
    execution.run_frame({});
    const auto before = main_result(execution).pixels;
    auto wide = experiment;
    wide.width = machine.context().info().max_texture_size + 1;
    try {
        execution.update(wide);
        FAIL() << "it is taken";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("pixels a side"), std::string::npos) << error.what();
    }
    execution.run_frame({});
    EXPECT_EQ(main_result(execution).pixels, before);
}

/// What is kept must not be kept too long.
TEST_F(StandsStill, AnyParameterOfSurfelsThatChangesGivesThePictureOfAFreshStart) {
    const auto& method = registry().at("deep-screen-space");
    for (const char* paths : {"ao", "indirect"}) {
        auto experiment = experiment_of(method);
        experiment.settings["paths"] = std::string(paths);
        experiment.settings["samples"] = std::int64_t{2};
        Execution execution(machine, experiment);
        execution.run_frame({});
        for (const auto& parameter : method.parameters) {
            if (parameter.key == "paths" || !is_active(parameter, experiment.settings)) continue;
            const auto before = experiment.settings[parameter.key];
            experiment.settings[parameter.key] = other(parameter, before);
            execution.update(experiment);
            execution.run_frame({});
            expect_as_anew(machine, execution, experiment, std::string(paths) + ", " + parameter.key);
            experiment.settings[parameter.key] = before;
        }
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
