#include "app/gui/camera_path.h"

#include <QLabel>

#include "app/gui/status_line.h"
#include "projects/motion.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/parameters/number_field.h"

namespace ir::gui {
namespace {

TEST_F(WindowTest, ACameraOfTheFileShowsItsPose) {
    open_scene();
    window.session().edit([](const projects::Project& project) {
        projects::Camera camera;
        camera.id = "aside";
        camera.scene_camera = "side";
        return projects::edits::add(project, camera);
    });
    window.document().select({widgets::ItemKind::camera, "aside"});
    const auto* x = window.document().findChild<widgets::NumberField*>("eye.x");
    ASSERT_TRUE(x);
    EXPECT_TRUE(QTest::qWaitFor([&] { return x->isVisible() && x->value() == 5; }));
    EXPECT_FALSE(x->isEnabled()) << "it is the file's";
}

class CameraPathTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        ASSERT_TRUE(QTest::qWaitFor([this] { return window.session().camera().pose().has_value(); }, 60000));
    }
    /// A gesture of a hand in the view.
    void look_from(const glm::dvec3& eye) {
        auto pose = *window.session().camera().pose();
        pose.eye = eye;
        window.session().camera().move(window.session().experiment()->id, pose);
        window.session().camera().finish_move();
        ASSERT_TRUE(settle());
    }
    void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        QTest::keyClick(&window, key, modifiers);
        ASSERT_TRUE(settle());
    }
    const projects::Motion* path() {
        return window.findChild<CameraPath*>()
                   ? window.findChild<CameraPath*>()->path(window.session().experiment()->id)
                   : nullptr;
    }
    bool says(const QString& text) {
        const auto labels = window.findChild<StatusLine*>()->findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(),
                           [&](const auto* each) { return each->text().contains(text); });
    }
    glm::dvec3 eye() { return window.session().camera().pose()->eye; }
    const projects::Project& document() { return window.session().document(); }
};

TEST_F(CameraPathTest, KeysFromTheViewMakeAPathThatPlaysAndIsUndone) {
    EXPECT_FALSE(window.action("camera-key-remove")->isEnabled());
    const auto begin = eye();
    press(Qt::Key_C);
    ASSERT_TRUE(path());
    EXPECT_TRUE(path()->smooth);
    ASSERT_EQ(path()->keys.size(), 1u);
    EXPECT_EQ(path()->keys[0].eye, begin);
    EXPECT_TRUE(says("Key 1 of 1"));
    EXPECT_FALSE(window.playback().can_play()) << "one key stands still";
    look_from({1, 2, 8});
    EXPECT_EQ(document().cameras.size(), 2u) << "who looks around leaves the path";
    press(Qt::Key_C);
    look_from({4, 2, 6});
    press(Qt::Key_C);
    ASSERT_EQ(path()->keys.size(), 3u);
    EXPECT_EQ(document().cameras.size(), 1u) << "and comes back with the next key, leaving nothing behind";
    EXPECT_EQ(window.session().experiment()->camera, path()->camera);
    EXPECT_EQ(path()->keys[1].time, 2);
    EXPECT_EQ(path()->keys[2].time, 4);
    EXPECT_NEAR(window.playback().time(), 4, 1e-9) << "the view stays at what was set";
    EXPECT_EQ(eye(), glm::dvec3(4, 2, 6));
    EXPECT_NEAR(window.playback().end(), 4, 1e-9);

    EXPECT_TRUE(says("Key 3 of 3"));
    press(Qt::Key_PageUp, Qt::AltModifier);
    EXPECT_TRUE(says("Key 2 of 3"));
    EXPECT_NEAR(window.playback().time(), 2, 1e-9);
    EXPECT_EQ(eye(), glm::dvec3(1, 2, 8));
    // In place of the key that is there.
    look_from({1, 3, 8});
    press(Qt::Key_C, Qt::ShiftModifier);
    ASSERT_EQ(path()->keys.size(), 3u);
    EXPECT_EQ(path()->keys[1].eye, glm::dvec3(1, 3, 8));
    // A new one between two.
    window.playback().seek(3);
    look_from({2, 3, 7});
    press(Qt::Key_C, Qt::ShiftModifier);
    ASSERT_EQ(path()->keys.size(), 4u);
    EXPECT_NEAR(path()->keys[2].time, 3, 1e-9);
    trigger("camera-key-remove");
    EXPECT_EQ(path()->keys.size(), 3u);
    EXPECT_TRUE(says("Removed key 3"));
    trigger("undo");
    EXPECT_EQ(path()->keys.size(), 4u);
    const auto before = steps();
    trigger("undo");
    EXPECT_EQ(path()->keys.size(), 3u);
    EXPECT_EQ(before - steps(), 1u) << "a key, the camera and what is left of looking around are one step";
    EXPECT_FALSE(window.playback().can_play()) << "looking around is not undone with it";
    press(Qt::Key_PageDown, Qt::AltModifier);
    EXPECT_EQ(window.session().experiment()->camera, path()->camera);
    window.action("play")->trigger();
    EXPECT_TRUE(window.playback().is_playing());
    window.playback().play(false);
}

TEST_F(CameraPathTest, TheLastKeyTakesThePathWithIt) {
    press(Qt::Key_C);
    ASSERT_TRUE(path());
    EXPECT_FALSE(window.action("camera-key-next")->isEnabled());
    trigger("camera-key-remove");
    EXPECT_FALSE(path());
    EXPECT_TRUE(document().motion.empty());
    EXPECT_TRUE(says("with its last key"));
    trigger("undo");
    EXPECT_TRUE(path());
}

}  // namespace
}  // namespace ir::gui
