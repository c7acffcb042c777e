#include "projects/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/edits.h"
#include "projects/results.h"
#include "projects/validate.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::registry;
using testing::sample_project;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

Motion of_light(std::vector<double> times) {
    Motion motion{"m", "M", "", {}};
    motion.kind = Motion::Kind::light;
    motion.lights = "evening";
    for (const double time : times) {
        motion.keys.emplace_back();
        motion.keys.back().time = time;
    }
    return motion;
}

TEST(Motion, ValuesAreLinearBetweenKeysAndStayAtTheEnds) {
    auto motion = of_light({1, 3, 4});
    for (int i = 0; i < 3; ++i) {
        motion.keys[std::size_t(i)].position = {2.0 * i, 0, 1};
        motion.keys[std::size_t(i)].intensity = 1 + i;
    }
    expect_near(*key_at(motion, 1.5).position, {0.5, 0, 1});
    EXPECT_DOUBLE_EQ(key_at(motion, 1.5).intensity, 1.25);
    expect_near(*key_at(motion, 3).position, {2, 0, 1});
    expect_near(*key_at(motion, -7).position, {0, 0, 1});
    expect_near(*key_at(motion, 99).position, {4, 0, 1});
}

TEST(Motion, ALoopBeginsAgainAfterItsLastKey) {
    auto motion = of_light({1, 3});
    motion.loop = true;
    motion.keys[1].intensity = 3;
    for (const double time : {1.5, 3.5, 5.5, -0.5})
        EXPECT_NEAR(key_at(motion, time).intensity, 1.5, 1e-12) << time;
    motion.keys.pop_back();  // a single key has no length
    EXPECT_EQ(key_at(motion, 7).intensity, 1);
}

Motion of_camera(std::vector<std::pair<double, glm::dvec3>> eyes) {
    Motion motion{"m", "M", "nave", {}};
    motion.smooth = true;
    for (const auto& [time, eye] : eyes) {
        motion.keys.emplace_back();
        motion.keys.back().time = time;
        motion.keys.back().eye = eye;
    }
    return motion;
}

TEST(Motion, SmoothPathsGoThroughTheirKeysWithoutABend) {
    const auto motion = of_camera({{0, {0, 0, 0}}, {1, {1, 2, 0}}, {3, {4, 1, 1}}, {4, {4, 0, 5}}});
    const auto eye = [&](double time) { return key_at(motion, time).eye; };
    for (const auto& key : motion.keys) expect_near(eye(key.time), key.eye);
    constexpr double h = 1e-6;
    for (const double time : {1.0, 3.0}) {
        const auto before = (eye(time) - eye(time - h)) / h, after = (eye(time + h) - eye(time)) / h;
        expect_near(before, after, 1e-4);
    }
    expect_near(eye(99), motion.keys.back().eye);
    expect_near(key_at(motion, 1.7).target, motion.keys[0].target);  // what all keys share stands still
}

TEST(Motion, SmoothPathsFollowLinesAndParabolasOfUnequalTimesExactly) {
    const auto parabola = [](double t) { return glm::dvec3(3 * t, t * t, 2 - t * t); };
    std::vector<std::pair<double, glm::dvec3>> eyes;
    for (const double time : {0.0, 0.5, 2.0, 3.0}) eyes.emplace_back(time, parabola(time));
    const auto motion = of_camera(eyes);
    for (const double time : {0.2, 1.0, 1.7, 2.9}) expect_near(key_at(motion, time).eye, parabola(time));
    const auto line = of_camera({{1, {0, 0, 0}}, {3, {2, 4, 0}}});
    expect_near(key_at(line, 1.5).eye, {0.5, 1, 0});
    const auto alone = of_camera({{1, {1, 2, 3}}});
    expect_near(key_at(alone, 5).eye, {1, 2, 3});
}

/// Whatever the times of the keys: of a hand that presses twice, keys stand a billionth of a second apart.
TEST(Motion, SmoothPathsStayNearTheirKeys) {
    const std::vector<double> gaps{1, 1e-9, 2, 1e-9, 1e-9, 0.5, 1e-3, 3};
    std::vector<std::pair<double, glm::dvec3>> along{{0, {0, 0, 0}}}, anywhere = along;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const double time = along.back().first + gaps[i];
        along.emplace_back(time, along.back().second + glm::dvec3(1 + double(i * i % 5), 0, 0));
        anywhere.emplace_back(time, glm::dvec3(double(i * 7 % 5), double(i * 3 % 4), double(i % 2)));
    }
    const auto line = of_camera(along), path = of_camera(anywhere);
    for (std::size_t i = 0; i + 1 < along.size(); ++i) {
        const auto &a = path.keys[i], &b = path.keys[i + 1];
        double before = line.keys[i].eye.x;
        for (int step = 1; step < 50; ++step) {
            const double s = step / 50.0, time = a.time + s * (b.time - a.time);
            const double x = key_at(line, time).eye.x;
            EXPECT_GE(x, before - 1e-6) << "turns back behind key " << i;
            EXPECT_LE(x, line.keys[i + 1].eye.x + 1e-6);
            before = x;
            // On the chord between both keys, and beside it by no more than three quarters of its length.
            const auto chord = glm::mix(a.eye, b.eye, s * s * (3 - 2 * s));
            EXPECT_LE(glm::distance(key_at(path, time).eye, chord), 0.75 * glm::distance(a.eye, b.eye) + 1e-5)
                << "behind key " << i;
        }
    }
}

TEST(Motion, AClosedLoopHasNoBendWhereItBeginsAgain) {
    auto motion =
        of_camera({{0, {1, 0, 0}}, {1, {0, 1, 0}}, {2, {-1, 0, 0}}, {3, {0, -1, 0}}, {4, {1, 0, 0}}});
    motion.loop = true;
    constexpr double h = 1e-6;
    const auto eye = [&](double time) { return key_at(motion, time).eye; };
    expect_near((eye(4) - eye(4 - h)) / h, (eye(h) - eye(0)) / h, 1e-4);
    motion.keys.back().eye = {2, 0, 0};  // open: it jumps
    expect_near(eye(4 - h), {2, 0, 0}, 1e-4);
}

TEST(Motion, DirectionsTurnAtAConstantSpeed) {
    auto motion = of_light({0, 3});
    motion.keys[0].direction = {2, 0, 0};
    motion.keys[1].direction = {0, 0, -5};
    const double angle = glm::radians(30.0);  // a third of a right angle
    expect_near(*key_at(motion, 1).direction, {std::cos(angle), 0, -std::sin(angle)});
}

TEST(Motion, RotationsOfPartsTakeTheShortestArc) {
    Motion motion = sample_project().motion.at(2);
    motion.keys[0].rotation = {0, -170, 0};
    motion.keys[1].rotation = {0, 170, 0};
    motion.keys[1].time = 2;
    const auto half = rotation_of(key_at(motion, 1).rotation) * glm::dvec3(1, 0, 0);
    expect_near(half, {-1, 0, 0});  // through 180°, not through 0°
}

/// Rz Ry Rx: x is turned first.
TEST(Motion, RotationsAreAboutFixedAxesInOrder) {
    expect_near(rotation_of({90, 90, 0}) * glm::dvec3(0, 1, 0), {1, 0, 0});
    expect_near(rotation_of({0, 90, 90}) * glm::dvec3(1, 0, 0), {0, 0, -1});
    expect_near(rotation_of({0, 0, 90}) * glm::dvec3(1, 0, 0), {0, 1, 0});
}

TEST(Motion, ATransformGivesTheKeyThatGivesIt) {
    for (const glm::dvec3& scale : {glm::dvec3(1), glm::dvec3(2, 0.5, 3), glm::dvec3(-1, 1, 2)}) {
        Motion::Key key;
        key.translation = {1, -2, 3};
        key.rotation = {20, -30, 140};
        key.scale = scale;
        const auto matrix = transform_of(key), back = transform_of(key_of(matrix));
        for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(back[i], matrix[i], 1e-12) << i;
    }
}

TEST(Motion, ALightKeepsWhatItsKeysDoNotGive) {
    const auto spot = parse_light("spot:position=0,3,0;target=0,0,0;intensity=10;outer=30");
    Motion::Key key;
    EXPECT_EQ(light_at(spot, key), spot);
    key.position = {5, 5, 5};
    key.intensity = 0.5;
    EXPECT_EQ(light_at(spot, key), parse_light("spot:position=5,5,5;target=0,0,0;intensity=5;outer=30"));
    key.direction = {1, 0, 0};
    EXPECT_FALSE(light_at(spot, key).target);
    expect_near(light_at(spot, key).travel(), {1, 0, 0});
    const auto sun = parse_light("directional:direction=0,-1,0;irradiance=3");
    EXPECT_EQ(light_at(sun, key).position, sun.position);
    const auto lamp = parse_light("point:position=0,2,0;flux=40");
    EXPECT_FALSE(light_at(lamp, key).direction);
}

TEST(Motion, TheLastOneOfTheSameThingCountsAndTheOthersAreNamed) {
    auto project = sample_project();
    auto second = project.motion[0];
    second.id = "second";
    second.keys[0].eye = {9, 9, 9};
    project.motion.push_back(second);
    EXPECT_EQ(motion_of_camera(project, "orbit")->id, "second");
    EXPECT_EQ(camera_at(project, project.cameras[0], 0).eye, glm::dvec3(9));
    const auto moved = motions_of(project, project.experiments[0]);
    ASSERT_EQ(moved.size(), 3u);
    EXPECT_EQ(moved[0]->id, "spot");
    EXPECT_EQ(moved[2]->id, "second");
    EXPECT_TRUE(motions_of(project, project.experiments[1]).empty());
    ReadProject read{project, schema_version, {}};
    const auto messages = check(read, ".", registry());
    EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [](const auto& message) {
        return message.text.find("motion 'walk': does not count") != std::string::npos;
    }));
}

TEST(Motion, WhatMovesNothingIsSaid) {
    auto project = sample_project();
    project.motion[1].light = 9;
    project.motion[2].part = 9;
    const auto messages = check({project, schema_version, {}}, ".", registry());
    for (const char* text : {"there is no light 9 in 'evening'", "there is no part 9 in 'church'"})
        EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [&](const auto& message) {
            return message.text.find(text) != std::string::npos;
        })) << text;
}

TEST(Motion, SenselessKeysAreRefused) {
    const auto refuses = [](const std::function<void(Motion&)>& spoil, std::size_t which, const char* why) {
        auto motion = sample_project().motion.at(which);
        validate(motion);
        spoil(motion);
        try {
            validate(motion);
            ADD_FAILURE() << "accepted: " << why;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
        }
    };
    refuses([](Motion& m) { m.keys[1].time = m.keys[0].time; }, 0, "ascend");
    refuses([](Motion& m) { m.keys[1].intensity = -1; }, 1, "at least 0");
    refuses([](Motion& m) { m.keys[1].position.reset(); }, 1, "the same of position");
    refuses([](Motion& m) { m.keys[1].direction = {1, 0, 0}; }, 1, "not both");
    refuses([](Motion& m) { m.keys[0].scale.x = 0; }, 2, "scaled by 0");
    refuses([](Motion& m) { m.keys[0].rotation.x = NAN; }, 2, "finite");
    refuses([](Motion& m) { m.part = -1; }, 2, "from 0");
    refuses(
        [](Motion& m) {
            for (auto& key : m.keys) key.look_at.reset(), key.direction = {0, -1, 0};
            m.keys[1].direction = {0, 2, 0};
        },
        1, "opposite");
}

/// What adds up over frames sees one moment: other moments' keys are nothing to it.
TEST(Motion, AMomentSeesWhereThingsAreAndNotHowTheyMove) {
    const auto project = sample_project();
    const auto& fog = project.experiments[0];
    const auto at_start = moment_inputs(project, fog, 0.5);
    auto later_key = project;
    later_key.motion[1].keys[2].intensity = 7;
    EXPECT_EQ(moment_inputs(later_key, fog, 0.5), at_start);
    for (const char* key : {"scene", "camera", "lights"})
        EXPECT_NE(moment_inputs(project, fog, 0.75).at(key), at_start.at(key)) << key;
}

TEST(Motion, ThingsThatMoveCannotBeRemovedUnderTheirMotion) {
    auto project = sample_project();
    project.experiments.clear();
    project.comparisons.clear();
    project.sweeps.clear();
    project.plots.clear();
    EXPECT_THROW(edits::remove<Scene>(project, "church"), UsageError);
    EXPECT_THROW(edits::remove<LightSet>(project, "evening"), UsageError);
    EXPECT_THROW(edits::remove<Camera>(project, "orbit"), UsageError);
    project.motion.clear();
    edits::remove<Scene>(project, "church");
    edits::remove<LightSet>(project, "evening");
    edits::remove<Camera>(project, "orbit");
}

}  // namespace
}  // namespace ir::projects
