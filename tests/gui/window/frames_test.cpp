#include <QFile>
#include <QSlider>
#include <QTemporaryDir>
#include <QToolButton>
#include <algorithm>
#include <filesystem>

#include "app/gui/experiment_camera.h"
#include "renderers/image/exr.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

class FramesTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        window.docks().raise("frames");
        ASSERT_TRUE(settle());
    }
    FramesDock& dock() { return *window.findChild<FramesDock*>(); }
    PastFrames& past() { return window.live().past(); }
    QSlider* slider() { return dock().panel().findChild<QSlider*>("frames"); }
    std::string caption() { return dock().panel().state().caption.toStdString(); }
    void press(Qt::Key key) {
        QTest::keyClick(&window, key, Qt::AltModifier);
        ASSERT_TRUE(settle());
    }
    void edit_level(double value) {
        const auto id = window.session().experiment()->id;
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), id, {{"level", value}});
        });
        window.session().end_gesture();
        ASSERT_TRUE(settle());
    }
};

TEST_F(FramesTest, KeysAndTheSliderGoBackThroughEditsInAllViews) {
    edit_level(0.5);
    edit_level(0.75);
    ASSERT_EQ(past().frames().size(), 3u);
    EXPECT_FLOAT_EQ(pixel(), 0.75f);
    EXPECT_FALSE(window.action("past-newer")->isEnabled());
    const auto asked = renderer.requests.size();
    press(Qt::Key_Comma);
    EXPECT_FLOAT_EQ(pixel(), 0.5f);
    EXPECT_TRUE(window.view().picture()->label.contains("past frame 2"));
    EXPECT_NE(caption().find("2 of 3"), std::string::npos) << caption();
    EXPECT_NE(caption().find("Level"), std::string::npos) << caption() << ": what was edited";
    QTest::keyClick(slider(), Qt::Key_Left);
    ASSERT_TRUE(settle());
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    EXPECT_TRUE(window.view().picture()->label.contains("past frame 1"));
    EXPECT_FALSE(window.action("past-older")->isEnabled());
    // All views, and a statistic of one.
    window.action("views-2")->trigger();
    window.docks().raise("profile");
    ASSERT_TRUE(settle());
    press(Qt::Key_Period);
    EXPECT_FLOAT_EQ(pixel(), 0.5f);
    EXPECT_EQ(renderer.requests.size(), asked) << "nothing is rendered or read back for what is past";
    press(Qt::Key_N);
    EXPECT_FLOAT_EQ(pixel(), 0.75f);
    EXPECT_FALSE(past().is_elsewhere());
}

TEST_F(FramesTest, AnEditLeadsBackToNow) {
    edit_level(0.5);
    press(Qt::Key_Comma);
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    edit_level(1);
    EXPECT_FALSE(past().is_elsewhere());
    EXPECT_FLOAT_EQ(pixel(), 1);
    trigger("undo");
    EXPECT_FLOAT_EQ(pixel(), 0.5f);
    EXPECT_NE(past().frames().back().change.find("Undo"), std::string::npos);
}

TEST_F(FramesTest, OnlyWhatViewsShowedIsKeptAndNothingElseIsClaimed) {
    edit_level(0.5);
    window.views().show_output("depth");
    ASSERT_TRUE(settle());
    ASSERT_EQ(past().frames().size(), 2u) << "the same frame with another picture is no new one";
    press(Qt::Key_Comma);
    EXPECT_FALSE(window.view().picture()->has_image());
    EXPECT_NE(window.view().picture()->note.toStdString().find("not kept"), std::string::npos);
    EXPECT_EQ(window.views().active_state().a.output, "depth");
    // Another view of what was kept.
    window.views().show_output("");
    ASSERT_TRUE(settle());
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    const QTemporaryDir folder;
    const auto file = folder.filePath("all.exr");
    EXPECT_THROW(window.export_controller().exports().save_all_buffers(file), Error);
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    EXPECT_NE(window.workspace().active_pane().space().view().note().toStdString().find("newest"),
              std::string::npos);
    press(Qt::Key_N);
    auto& space = window.workspace().active_pane().space().view();
    EXPECT_TRUE(QTest::qWaitFor([&] { return space.note().isEmpty() && !space.picture().colour.empty(); }));
}

TEST_F(FramesTest, TheInspectorReadsThePastFrame) {
    window.docks().raise("inspector");
    edit_level(0.5);
    ASSERT_TRUE(settle());
    const auto asked = renderer.probes.size();
    press(Qt::Key_Comma);
    window.inspector().pin({3, 2});
    ASSERT_TRUE(settle());
    EXPECT_EQ(renderer.probes.size(), asked);
    const auto probed = engine::probe(*window.live().result(window.session().experiment()->id), "picture",
                                      {{3, 2}, {-1, 0}, {100000, 0}});
    ASSERT_FALSE(probed.rows.empty());
    EXPECT_EQ(probed.rows.front().key, "picture");
    EXPECT_FLOAT_EQ(probed.rows.front().values.at(0).at(0), 0.25f);
    EXPECT_TRUE(probed.rows.front().values.at(1).empty());
    EXPECT_TRUE(probed.rows.front().values.at(2).empty());
    EXPECT_FALSE(probed.rows.at(1).available) << "what was not sent";
}

TEST_F(FramesTest, OldFramesGoFirstButNoneWhileOneIsShown) {
    const double one = double(past().bytes()) / 1024 / 1024;
    emit dock().panel().limit_chosen(2.5 * one);
    edit_level(0.5);
    edit_level(0.75);
    ASSERT_EQ(past().frames().size(), 2u);
    EXPECT_EQ(past().frames().front().number, 2u);
    press(Qt::Key_Comma);
    EXPECT_FLOAT_EQ(pixel(), 0.5f);
    emit dock().panel().limit_chosen(1.5 * one);
    EXPECT_EQ(past().frames().size(), 1u);
    EXPECT_FLOAT_EQ(pixel(), 0.5f) << "what is shown stays";
    EXPECT_TRUE(dock().panel().findChild<QToolButton*>("now")->isEnabled()) << "the last one, but past";
    emit dock().panel().limit_chosen(0);
    press(Qt::Key_N);
    EXPECT_TRUE(past().frames().empty()) << "nothing holds it any more";
    edit_level(1);
    EXPECT_TRUE(past().frames().empty());
    EXPECT_EQ(past().bytes(), 0u);
    EXPECT_FALSE(caption().empty());
    projects::Json memory;
    dock().save(memory);
    emit dock().panel().limit_chosen(64);
    dock().load(memory);
    EXPECT_EQ(past().limit(), 0u);
    dock().load({{"frames", {{"limit_mib", "many"}}}});
    EXPECT_EQ(past().limit(), PastFrames::standard_limit);
}

/// Of small pictures they are most of what a frame takes.
TEST_F(FramesTest, ReportsCountInTheLimit) {
    engine::LiveResult result;
    result.report.passes.resize(20);
    ResourceReport resource;
    resource.doc = std::string(100, 'x');
    result.report.resources.assign(50, resource);
    past().clear();
    past().set_limit(100'000);
    for (std::uint64_t run = 1; run <= 50; ++run) {
        result.run = run;
        past().add({std::make_shared<engine::LiveResult>(result), {}, "", ""});
    }
    EXPECT_GE(past().frames().size(), 1u);
    EXPECT_LE(past().frames().size() * 50 * (sizeof(ResourceReport) + 100), 100'000u);
}

TEST_F(FramesTest, AnotherMethodForgetsAndAFrameBecomesAnExperiment) {
    edit_level(0.5);
    press(Qt::Key_Comma);
    auto* button = dock().panel().findChild<QToolButton*>("frame-experiment");
    ASSERT_TRUE(button->isEnabled());
    const auto before = window.session().experiment()->id;
    QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.session().document().experiments.size(), 2u);
    EXPECT_NE(window.session().experiment()->id, before);
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    EXPECT_TRUE(window.session().document().cameras.empty()) << "nobody has moved it";
    EXPECT_FALSE(button->isEnabled());
    trigger("undo");
    EXPECT_EQ(window.session().document().experiments.size(), 1u);
    EXPECT_TRUE(window.session().document().cameras.empty());
    window.session().select_experiment(before);
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_method(project, fake_registry(), before, "filter");
    });
    ASSERT_TRUE(settle());
    for (const auto& frame : past().frames()) EXPECT_EQ(frame.experiment.method, "filter");
}

TEST_F(FramesTest, AFrameThatAnotherCameraSawKeepsIt) {
    ASSERT_TRUE(QTest::qWaitFor([this] { return window.session().camera().pose().has_value(); }, 60000));
    edit_level(0.5);
    auto pose = *window.session().camera().pose();
    pose.eye += glm::dvec3(0, 1, 0);
    window.session().camera().move(window.session().experiment()->id, pose, {});
    window.session().camera().finish_move();
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.session().document().cameras.size(), 1u);
    past().show(0);
    ASSERT_TRUE(settle());
    QTest::mouseClick(dock().panel().findChild<QToolButton*>("frame-experiment"), Qt::LeftButton);
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.session().document().cameras.size(), 2u);
    EXPECT_EQ(window.session().experiment()->camera, window.session().document().cameras.back().id);
}

TEST_F(FramesTest, APastFrameIsNotExplainedByTheNewest) {
    edit_level(0.5);
    press(Qt::Key_Comma);
    window.inspector().explain({20, 10});
    EXPECT_FALSE(window.inspector().explained().has_value());
    EXPECT_TRUE(label("state").find("Alt+N") != std::string::npos) << label("state");
    EXPECT_TRUE(past().is_elsewhere());
    press(Qt::Key_N);
    window.inspector().explain({20, 10});
    EXPECT_TRUE(window.inspector().explained().has_value());
    ASSERT_TRUE(settle());
    press(Qt::Key_Comma);
    for (const auto* each : window.inspector().explain_panel().findChildren<QLabel*>())
        if (each->text().contains("Alt+N")) return;
    ADD_FAILURE() << "the panel says nothing of it";
}

TEST_F(FramesTest, OnlyWhatAPersonDoesLeavesThePastAndIsNamed) {
    const auto first = window.session().experiment()->id;
    trigger("experiment-duplicate");
    const auto second = window.session().experiment()->id;
    window.session().select_experiment(first);
    ASSERT_TRUE(settle());
    edit_level(0.5);
    press(Qt::Key_Comma);
    ASSERT_TRUE(past().is_elsewhere());
    // Something that was not looked at comes into a view.
    trigger("views-2");
    window.workspace().area().set_active(1);
    window.views().show_owner(second);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(past().is_elsewhere());
    for (const auto& frame : past().frames()) {
        if (frame.result->tag != second) continue;
        EXPECT_EQ(frame.change, "") << "the edit was another experiment's";
    }
    // Time goes on.
    ASSERT_TRUE(window.session().edit([](const projects::Project& project) {
        projects::Motion motion{"slide", "Slide", "", {}};
        motion.kind = projects::Motion::Kind::part;
        motion.scene = project.scenes.front().id;
        motion.keys.resize(2);
        motion.keys[1].time = 60;
        motion.keys[1].translation = {3, 0, 0};
        return projects::edits::add(project, motion);
    }));
    window.session().end_gesture();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(past().is_elsewhere()) << "an edit is what a person does";
    window.playback().play(true);
    ASSERT_TRUE(QTest::qWaitFor([&] { return past().frames().size() > 6; }));
    QTest::keyClick(&window, Qt::Key_Comma, Qt::AltModifier);
    ASSERT_TRUE(past().is_elsewhere());
    const auto asked = renderer.requests.size();
    ASSERT_TRUE(QTest::qWaitFor([&] { return renderer.requests.size() > asked + 4; })) << "it plays on";
    EXPECT_TRUE(past().is_elsewhere());
    window.playback().play(false);
    EXPECT_FALSE(past().is_elsewhere()) << "who stops it looks at where it stands";
    window.playback().play(true);
    QTest::keyClick(&window, Qt::Key_Comma, Qt::AltModifier);
    ASSERT_TRUE(past().is_elsewhere());
    window.playback().set_end(window.playback().time() + 0.2);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.playback().is_playing(); }));
    EXPECT_TRUE(past().is_elsewhere()) << "it came to its end by itself";
    window.playback().seek(0);
    EXPECT_FALSE(past().is_elsewhere()) << "who moves through time wants to see it";
}

TEST_F(FramesTest, FramesOfARemovedExperimentGoWithIt) {
    trigger("experiment-duplicate");
    const auto copy = window.session().experiment()->id;
    edit_level(0.75);
    EXPECT_TRUE(std::ranges::any_of(past().frames(), [&](const auto& f) { return f.result->tag == copy; }));
    past().show(0);
    ASSERT_TRUE(past().is_elsewhere());
    trigger("experiment-remove");
    EXPECT_FALSE(past().is_elsewhere()) << "what was shown is the newest frame now";
    EXPECT_FALSE(past().frames().empty());
    EXPECT_TRUE(std::ranges::none_of(past().frames(), [&](const auto& f) { return f.result->tag == copy; }));
    trigger("undo");
    EXPECT_TRUE(std::ranges::any_of(past().frames(), [&](const auto& f) {
        return f.result->tag == copy && f.number < past().frames().back().number;
    })) << "with it they are back";
    EXPECT_TRUE(std::ranges::is_sorted(past().frames(), {}, &PastFrame::number));
    trigger("redo");
    const auto before = past().bytes();
    past().set_limit(before - 1);
    EXPECT_LT(past().bytes(), before);
    past().set_limit(PastFrames::standard_limit);
    trigger("undo");
    EXPECT_FALSE(past().frames().empty());
}

/// By a program of that name, as none need be installed.
TEST_F(FramesTest, KeptFramesBecomeAVideo) {
    edit_level(0.5);
    const QTemporaryDir folder;
    const auto path = qgetenv("PATH");
    const auto words = folder.filePath("words");
    QFile program(folder.filePath("ffmpeg"));
    ASSERT_TRUE(program.open(QIODevice::WriteOnly));
    program.write(("#!/bin/sh\nfor word; do echo \"$word\"; last=${word#file:}; done >'" + words + "'" +
                   "\nfor word; do last=${word#file:}; done\necho film >\"$last\"\n")
                      .toUtf8());
    program.close();
    program.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    qputenv("PATH", folder.path().toUtf8() + ":" + path);
    const auto film = folder.filePath("film.mp4");
    dock().save_film(FramesDock::Film::video, film);
    EXPECT_TRUE(dock().is_saving());
    EXPECT_TRUE(QTest::qWaitFor([&] { return !dock().is_saving(); }, 60000));
    qputenv("PATH", path);
    EXPECT_TRUE(QFile::exists(film)) << window.banners().text("file").toStdString();
    QFile said(words);
    ASSERT_TRUE(said.open(QIODevice::ReadOnly));
    EXPECT_TRUE(said.readAll().contains(".png"));
}

TEST_F(FramesTest, KeptFramesBecomeFiles) {
    edit_level(0.5);
    edit_level(0.75);
    const auto wait = [&] { return QTest::qWaitFor([&] { return !dock().is_saving(); }, 60000); };
    const QTemporaryDir folder;
    dock().save_film(FramesDock::Film::values, folder.path());
    ASSERT_TRUE(wait());
    const auto path = std::filesystem::path(folder.path().toStdString());
    for (int i = 0; i < 3; ++i) {
        const auto layers = read_exr(path / ("000" + std::to_string(i + 1) + ".exr"));
        EXPECT_NEAR(layers.at(0).image.at(0, 0), 0.25 * (i + 1), 1e-3);
    }
    dock().save_film(FramesDock::Film::pictures, folder.path());
    ASSERT_TRUE(wait());
    EXPECT_TRUE(std::filesystem::exists(path / "0003.png"));
    EXPECT_FALSE(std::filesystem::exists(path / "0004.png"));
}

}  // namespace
}  // namespace ir::gui
