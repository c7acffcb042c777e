// Cameras, lights and parts of scenes that move by key frames, over the frames of an execution.
#include <gtest/gtest.h>

#include "app/engine/from_project.h"
#include "app/engine/live_session.h"
#include "app/engine/moving.h"
#include "app/engine/pictures.h"
#include "projects/motion.h"
#include "projects/samples.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir::engine {
namespace {

using projects::Motion;
constexpr int side = 32;
constexpr double frame = projects::frame_seconds;

/// A plane of 8 m seen straight from above, 16 pixels a metre, +x to the right and -z up.
projects::Project plane_from_above() {
    projects::Project project;
    project.scenes = {{"plane", "Plane", {{"builtin:plane?size=8", "", {}}}}};
    projects::Camera camera{{{{0, 5, 0}, {0, 0, 0}, {0, 0, -1}}}, "above", "Above", ""};
    camera.orthographic = true;
    camera.height = 2;
    project.cameras = {camera};
    projects::LightSet lamps;
    lamps.id = lamps.name = "lamps";
    lamps.lights = {projects::parse_light("point:position=0,1,0;flux=40"),
                    projects::parse_light("spot:position=0,3,0;target=0,0,0;intensity=10;outer=30")};
    project.lights = {lamps};
    projects::Experiment experiment;
    experiment.id = experiment.name = "e";
    experiment.scene = "plane";
    experiment.camera = "above";
    experiment.lights = "lamps";
    experiment.method = "view-normals";
    experiment.values = defaults(registry().at(experiment.method).parameters);
    experiment.size = {side, side};
    experiment.frames = 3;
    project.experiments = {experiment};
    return project;
}

Motion slide(Motion::Kind kind, double seconds) {
    Motion motion{"m", "M", "above", {}};
    motion.kind = kind;
    motion.scene = "plane";
    motion.lights = "lamps";
    motion.keys.resize(2);
    motion.keys[1].time = seconds;
    return motion;
}

class MotionTest : public testing::Test {
  protected:
    std::unique_ptr<Execution> execution(const projects::Project& project) {
        return std::make_unique<Execution>(machine, from_project(project, project.experiments.front(), "."));
    }
    Image velocity_after(Execution& execution, int frames) {
        graph::FrameOptions options;
        options.wanted = {"gbuffer.velocity"};
        for (int i = 0; i < frames; ++i) execution.run_frame(options);
        return execution.graph().read_image("gbuffer.velocity").value();
    }
    static void expect_velocity(const Image& velocity, glm::vec2 expected) {
        for (const glm::ivec2 pixel : {glm::ivec2(2, 3), glm::ivec2(16, 16), glm::ivec2(29, 20)})
            for (int i = 0; i < 2; ++i)
                EXPECT_NEAR(velocity.at(pixel.x, pixel.y, i), expected[i], 5e-3)
                    << "pixel " << pixel.x << ", " << pixel.y << " component " << i;
    }
    Machine machine;
};

TEST_F(MotionTest, APartThatSlidesHasItsVelocityInPixels) {
    auto project = plane_from_above();
    auto motion = slide(Motion::Kind::part, 2);
    motion.keys[1].translation = {6, 0, -3};  // 3 m/s to the right, 1.5 m/s up: 1.6 and 0.8 pixels a frame
    project.motion = {motion};
    const auto run = execution(project);
    expect_velocity(velocity_after(*run, 1), {0, 0});
    expect_velocity(velocity_after(*run, 1), {1.6, -0.8});
    expect_velocity(velocity_after(*run, 1), {1.6, -0.8});
    // What the last frames left is not the history of a new one.
    run->restart();
    expect_velocity(velocity_after(*run, 1), {0, 0});
    run->restart(2);
    EXPECT_DOUBLE_EQ(run->time(), 2 * frame);
    expect_velocity(velocity_after(*run, 1), {0, 0});
}

/// By which `compare` knows whether the moment of a file matters.
TEST_F(MotionTest, FilesSayWhetherAnythingMoves) {
    auto project = plane_from_above();
    const auto says = [&] {
        const auto run = execution(project);
        run->run_frame({});
        return attributes(*run).at("interreflect.moves");
    };
    EXPECT_EQ(says(), "false");
    for (const auto kind : {Motion::Kind::part, Motion::Kind::camera, Motion::Kind::light}) {
        auto motion = slide(kind, 1);
        motion.camera = "above";
        motion.keys[1].translation = {1, 0, 0};
        motion.keys[0].eye = {0, 5, 0};
        motion.keys[1].eye = {1, 5, 0};
        motion.keys[0].up = motion.keys[1].up = {0, 0, -1};
        motion.keys[1].intensity = 2;
        project.motion = {motion};
        EXPECT_EQ(says(), "true") << to_string(kind);
    }
    project = plane_from_above();
    project.scenes[0].parts[0].source = "builtin:corridor";
    EXPECT_EQ(says(), "true");
}

TEST_F(MotionTest, APartThatTurnsHasTheVelocityOfEachOfItsPoints) {
    auto project = plane_from_above();
    auto motion = slide(Motion::Kind::part, 1);
    motion.keys[1].rotation = {0, 90, 0};
    project.motion = {motion};
    const auto run = execution(project);
    const auto velocity = velocity_after(*run, 2);
    const double angle = glm::radians(3.0);  // a frame
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(31, 4), glm::ivec2(16, 25)}) {
        const glm::dvec2 p = glm::dvec2(pixel) + 0.5 - 16.0;  // pixels right of and below the axis
        // About +y, seen from above, it turns against the clock.
        const glm::dvec2 before{std::cos(angle) * p.x - std::sin(angle) * p.y,
                                std::sin(angle) * p.x + std::cos(angle) * p.y};
        EXPECT_NEAR(velocity.at(pixel.x, pixel.y, 0), p.x - before.x, 5e-3);
        EXPECT_NEAR(velocity.at(pixel.x, pixel.y, 1), p.y - before.y, 5e-3);
    }
}

/// A triangle of a file whose far corner goes 6 m to the right in a second, by a morph target.
std::string write_growing_triangle(const test::TemporaryFolder& folder) {
    test::GltfBuilder builder;
    builder.draw({{"POSITION", builder.floats({-3, 0, 3, 3, 0, 3, 0, 0, -5}, "VEC3")}});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", builder.floats({0, 0, 0, 0, 0, 0, 6, 0, 0}, "VEC3")}}};
    const int input = builder.floats({0, 1}, "SCALAR"), output = builder.floats({0, 1}, "SCALAR");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", output}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    return test::write_file(folder, "growing.gltf", builder.embedded_text());
}

TEST_F(MotionTest, AMeshThatDeformsHasTheVelocityOfEachOfItsPoints) {
    const test::TemporaryFolder folder;
    auto project = plane_from_above();
    project.scenes[0].parts[0].source = write_growing_triangle(folder);
    Machine host{{.backend = {}, .device = {}, .processor = Processor::host}};
    Machine device{{.backend = {}, .device = {}, .processor = Processor::gl}};
    for (auto* each : {&host, &device}) {
        Execution run(*each, from_project(project, project.experiments.front(), "."));
        const auto velocity = velocity_after(run, 2);
        for (const glm::ivec2 pixel : {glm::ivec2(16, 1), glm::ivec2(5, 16), glm::ivec2(28, 30)}) {
            // By how much the pixel's point belongs to the corner that goes 0.2 m a frame, 16 pixels a metre.
            const double z = (pixel.y + 0.5 - 16) / 16;
            EXPECT_NEAR(velocity.at(pixel.x, pixel.y, 0), 3.2 * (3 - z) / 8, 5e-3) << pixel.y;
            EXPECT_NEAR(velocity.at(pixel.x, pixel.y, 1), 0, 5e-3);
        }
    }
}

TEST_F(MotionTest, ACameraMovesFromFrameToFrame) {
    auto project = plane_from_above();
    auto motion = slide(Motion::Kind::camera, 1);
    for (auto& key : motion.keys) key.eye = {0, 5, 0}, key.up = {0, 0, -1};
    motion.keys[1].eye.x = motion.keys[1].target.x = 3;
    project.motion = {motion};
    const auto run = execution(project);
    EXPECT_TRUE(run->is_moving());
    expect_velocity(velocity_after(*run, 1), {0, 0});
    expect_velocity(velocity_after(*run, 1), {-1.6, 0});
    EXPECT_NEAR(run->camera().eye.x, 0.1, 1e-6);
    EXPECT_NEAR(run->inputs().previous_view.eye_ws.x, 0, 1e-6);
}

TEST_F(MotionTest, LightsMoveDimAndTurnUntilTheLastKey) {
    auto project = plane_from_above();
    auto motion = slide(Motion::Kind::light, frame);
    motion.light = 1;
    motion.keys[0].position = {0, 3, 0};
    motion.keys[1].position = {3, 3, 0};
    motion.keys[1].intensity = 0.5;
    project.motion = {motion};
    const auto run = execution(project);
    graph::FrameOptions options;
    run->run_frame(options);
    const auto first = run->world().lights.at(1);
    EXPECT_EQ(first.position, glm::vec3(0, 3, 0));
    EXPECT_FLOAT_EQ(first.intensity, 10);
    EXPECT_FALSE(run->world().lights_moved);
    run->run_frame(options);
    const auto second = run->world().lights.at(1);
    EXPECT_EQ(second.position, glm::vec3(3, 3, 0));
    EXPECT_FLOAT_EQ(second.intensity, 5);
    EXPECT_NEAR(second.direction.x, -std::sqrt(0.5), 1e-6) << "it goes on looking at its target";
    EXPECT_TRUE(run->world().lights_moved);
    run->run_frame(options);
    EXPECT_FALSE(run->world().lights_moved) << "after its last key it stands";
    EXPECT_EQ(run->world().lights.at(0).position, glm::vec3(0, 1, 0));
}

TEST_F(MotionTest, LightsOfTheScenesFileMoveByName) {
    auto project = plane_from_above();
    project.scenes = {{"plane", "Box", {{"builtin:cornell", "", {}}}}};
    project.experiments[0].lights = projects::scene_lights;
    SceneCache cache;
    const auto scene = cache.load("builtin:cornell");
    ASSERT_FALSE(scene->lights.empty());
    auto motion = slide(Motion::Kind::light, frame);
    motion.lights = projects::scene_lights;
    motion.light_name = scene->lights.front().name;
    motion.keys[1].intensity = 0;
    project.motion = {motion};
    const auto run = execution(project);
    run->run_frame({});
    EXPECT_FLOAT_EQ(run->world().lights.at(0).intensity, scene->lights.front().intensity);
    run->run_frame({});
    EXPECT_EQ(run->world().lights.at(0).intensity, 0);
}

TEST_F(MotionTest, ASetThatKeepsTheScenesLightsMovesItsOwnByNumberAndTheScenesByName) {
    auto project = plane_from_above();
    project.scenes = {{"plane", "Box", {{"builtin:cornell", "", {}}}}};
    project.lights[0].use_scene_lights = true;
    SceneCache cache;
    const auto scene = cache.load("builtin:cornell");
    ASSERT_FALSE(scene->lights.empty());
    auto own = slide(Motion::Kind::light, frame), files = own;
    own.light = 1;
    own.keys[1].intensity = 0.5;
    files.id = "n";
    files.light_name = scene->lights.front().name;
    files.keys[1].intensity = 0;
    project.motion = {own, files};
    const auto run = execution(project);
    run->run_frame({});
    const auto& lights = run->world().lights;
    ASSERT_EQ(lights.size(), scene->lights.size() + 2);
    EXPECT_FLOAT_EQ(lights[1].intensity, 10);
    EXPECT_FLOAT_EQ(lights[2].intensity, scene->lights.front().intensity);
    run->run_frame({});
    EXPECT_FLOAT_EQ(lights[1].intensity, 5);
    EXPECT_EQ(lights[2].intensity, 0);
    EXPECT_EQ(used_lights(*run).size(), 2 + scene->lights.size());
}

/// The reference's frames add up, so its picture is of one moment, whatever moves.
TEST_F(MotionTest, WhatAddsUpSeesOneMomentWithEverythingInItsPlace) {
    auto project = plane_from_above();
    auto& experiment = project.experiments[0];
    experiment.method = registry().reference()->id;
    experiment.values = defaults(registry().at(experiment.method).parameters);
    experiment.frames = 1;
    experiment.values["paths"] = std::string("direct");
    experiment.time = 0.5;
    auto still = project;
    auto motion = slide(Motion::Kind::light, 1);
    motion.keys[0].position = {0, 1, 0};
    motion.keys[1].position = {2, 1, 0};
    project.motion = {motion};
    still.lights[0].lights[0].position = {1, 1, 0};
    const auto at = [&](const projects::Project& which) {
        const auto run = execution(which);
        run->run_frame({});
        EXPECT_TRUE(run->state()) << "a moment can be continued";
        return main_result(*run).pixels;
    };
    const auto moved = at(project);
    EXPECT_EQ(moved, at(still));
    project.experiments[0].time = 0;
    EXPECT_NE(moved, at(project)) << "another moment has another light";
}

TEST_F(MotionTest, ALostHistoryBeginsAgainALittleBefore) {
    auto project = plane_from_above();
    auto motion = slide(Motion::Kind::part, 2);
    motion.keys[1].translation = {6, 0, 0};
    project.motion = {motion};
    LiveSession session(machine);
    LiveRequest request;
    request.tag = "e";
    request.experiment = from_project(project, project.experiments.front(), ".");
    request.parts = {Part{"gbuffer.velocity", 0, 0}};
    request.frames_again = 2;
    const auto advance = [&] { return session.advance(request, 1, {}); };
    request.experiment.frames = 10;
    auto result = advance();  // a fresh execution: frames 9 and 10 of the request
    EXPECT_NEAR(result.time, 8 * frame, 1e-9);
    EXPECT_EQ(result.history, 1);
    EXPECT_FALSE(result.finished);
    result = advance();
    EXPECT_TRUE(result.finished);
    request.experiment.frames = 11;
    result = advance();
    EXPECT_EQ(result.history, 3) << "the next frame goes on";
    EXPECT_NEAR(result.images.begin()->second.at(16, 16, 0), 1.6, 5e-3);
    request.experiment.seed = 7;
    result = advance();
    EXPECT_EQ(result.history, 1);
    EXPECT_NEAR(result.time, 9 * frame, 1e-9);
    request.frames_again = 0;  // the picture as it is defined, from the first frame on
    result = advance();
    EXPECT_NEAR(result.time, 0, 1e-9);
    EXPECT_EQ(result.history, 1);
}

}  // namespace
}  // namespace ir::engine
