#include <QTemporaryDir>
#include <QToolButton>
#include <fstream>

#include "projects/motion.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/timeline/time_bar.h"

namespace ir::gui {
namespace {

constexpr double frame = 1.0 / 30;

class TimelineWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    /// The scene slides by 3 m in 0.2 s.
    void add_motion() {
        ASSERT_TRUE(window.session().edit([](const projects::Project& project) {
            projects::Motion motion{"slide", "Slide", "", {}};
            motion.kind = projects::Motion::Kind::part;
            motion.scene = project.scenes.front().id;
            motion.keys.resize(2);
            motion.keys[1].time = 0.2;
            motion.keys[1].translation = {3, 0, 0};
            return projects::edits::add(project, motion);
        }));
        window.session().end_gesture();
        ASSERT_TRUE(settle());
    }
    Playback& playback() { return window.playback(); }
    const engine::Experiment& requested() { return renderer.requests.back().experiment; }
    QToolButton* button(const char* name) { return window.timeline().findChild<QToolButton*>(name); }
    const widgets::TimelineState& shown() { return window.timeline().panel().state(); }
};

/// One window for what belongs together: each takes a while to start.
TEST_F(TimelineWindowTest, PlaysFrameByFramePausesStepsAndScrubs) {
    EXPECT_FALSE(shown().empty.isEmpty());
    playback().play(true);
    EXPECT_FALSE(playback().is_playing());  // nothing moves
    add_motion();
    EXPECT_TRUE(shown().empty.isEmpty());
    ASSERT_EQ(shown().tracks.size(), 1u);
    EXPECT_EQ(shown().tracks[0].keys, (std::vector<double>{0, 0.2}));
    EXPECT_NEAR(shown().end, 0.2, 1e-6);
    EXPECT_FALSE(shown().is_elsewhere);

    // Every frame follows the one before in one history, up to the end.
    const auto first = renderer.requests.size();
    const auto steps = window.session().open_project().undo_stack().can_undo();
    window.action("play")->trigger();
    EXPECT_TRUE(playback().is_playing());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !playback().is_playing(); }, 60000));
    int frames = 1;
    for (auto i = first; i < renderer.requests.size(); ++i) {
        const auto& request = renderer.requests[i];
        EXPECT_EQ(request.experiment.time, 0);
        EXPECT_LE(request.experiment.frames - frames, 1) << "a frame is missing";
        EXPECT_GE(request.experiment.frames, frames);
        frames = request.experiment.frames;
    }
    EXPECT_EQ(frames, 7);  // 0.2 s after the first
    EXPECT_NEAR(playback().time(), 0.2, 1e-9);
    EXPECT_EQ(window.session().open_project().undo_stack().can_undo(), steps);

    // Back: another history. On: the same.
    window.action("step-back")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_NEAR(requested().time, 5 * frame, 1e-9);
    EXPECT_EQ(requested().frames, 1);
    window.action("step-forward")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_NEAR(requested().time, 5 * frame, 1e-9);
    EXPECT_EQ(requested().frames, 2);
    EXPECT_EQ(renderer.requests.back().frames_again, 1);

    // A loop goes on at the beginning.
    playback().set_loop(true);
    playback().play(true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return playback().time() > 4 * frame; }, 60000));
    ASSERT_TRUE(QTest::qWaitFor([&] { return playback().time() < 3 * frame; }, 60000));
    EXPECT_TRUE(playback().is_playing());
    playback().play(false);
    ASSERT_TRUE(settle());
    const auto* next_frame = playback().findChild<QTimer*>();
    ASSERT_TRUE(next_frame);
    EXPECT_FALSE(next_frame->isActive());
    EXPECT_FALSE(playback().is_playing());

    auto& bar = window.timeline().panel().bar();
    emit bar.time_chosen(3 * frame);
    ASSERT_TRUE(settle());
    EXPECT_NEAR(requested().time, 3 * frame, 1e-9);
    EXPECT_EQ(requested().frames, 1);
    emit window.timeline().panel().return_wanted();
    ASSERT_TRUE(settle());
    EXPECT_EQ(requested().time, 0);
    EXPECT_EQ(renderer.requests.back().frames_again, 0);
}

TEST_F(TimelineWindowTest, WhatASceneAnimatesIsKnownOfTheScenesFilesBeforeItIsLoaded) {
    const QTemporaryDir folder;
    const auto file = (folder.path() + "/door.gltf").toStdString();
    std::ofstream(file) << R"({"asset": {"version": "2.0"}, "nodes": [{"name": "door"}],
        "accessors": [{"componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1.5]},
                      {"componentType": 5126, "count": 2, "type": "VEC3"}],
        "animations": [{"samplers": [{"input": 0, "output": 1}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]})";
    renderer.hold = true;  // nothing is loaded
    const auto moves = [this] { return playback().can_play(); };
    ASSERT_TRUE(window.open_path(QString::fromStdString(file)));
    ASSERT_TRUE(QTest::qWaitFor(moves, 60000));
    EXPECT_NEAR(playback().end(), 1.5, 1e-6);
    ASSERT_EQ(shown().tracks.size(), 1u);
    EXPECT_NEAR(shown().tracks[0].end, 1.5, 1e-6);
    EXPECT_NEAR(window.live().scene_end(window.session().experiment()->scene), 1.5, 1e-6);

    // A reference is of the moment that the picture is of.
    const auto id = window.session().experiment()->id;
    window.session().edit([&](const auto& project) { return projects::edits::set_frames(project, id, 16); });
    window.references().match(id);
    const auto* truth = window.session().experiment(window.session().experiment(id)->reference);
    ASSERT_TRUE(truth);
    EXPECT_NEAR(truth->time, 15 * frame, 1e-6);

    ASSERT_TRUE(window.open_path("builtin:corridor?seconds=4"));
    EXPECT_TRUE(moves());
    EXPECT_NEAR(playback().end(), 4, 1e-6);
}

TEST_F(TimelineWindowTest, TheTimeIsTheViewsUntilItIsSetAndIsRemembered) {
    add_motion();
    auto& session = window.session();
    playback().seek(4 * frame);
    ASSERT_TRUE(settle());
    EXPECT_EQ(session.experiment()->time, 0);
    EXPECT_FALSE(window.results().why_not_keep().isEmpty());
    projects::Json memory = projects::Json::object();
    playback().set_loop(true);
    playback().set_end(2);
    playback().save(memory);

    button("set-time")->click();
    ASSERT_TRUE(settle());
    EXPECT_NEAR(session.experiment()->time, 4 * frame, 1e-9);
    EXPECT_FALSE(playback().is_elsewhere());
    session.undo();
    ASSERT_TRUE(settle());
    EXPECT_EQ(session.experiment()->time, 0);

    playback().load(projects::Json::object());
    EXPECT_FALSE(playback().loops());
    EXPECT_NEAR(playback().end(), 0.2, 1e-6);
    playback().load(memory);
    EXPECT_TRUE(playback().loops());
    EXPECT_EQ(playback().end(), 2);
    EXPECT_NEAR(playback().time(), 4 * frame, 1e-9);
    for (const char* odd : {R"({"timeline": 3})", R"({"timeline": {"end": "x", "time": 1e300, "loop": 2}})"})
        playback().load(projects::Json::parse(odd));
    EXPECT_FALSE(playback().is_elsewhere());
}

}  // namespace
}  // namespace ir::gui
