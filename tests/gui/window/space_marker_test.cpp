#include "app/gui/space_marker.h"

#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

class SpaceMarkerTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        ASSERT_TRUE(QTest::qWaitFor([this] { return window.session().camera().pose().has_value(); }, 60000));
    }
    widgets::SpaceView& space() { return window.workspace().active_pane().space().view(); }
    std::string owner() { return window.session().experiment()->id; }
    SpaceMarker& marker() { return *window.findChild<SpaceMarker*>(); }
    CameraPose pose() { return *window.session().camera().pose(); }
};

TEST_F(SpaceMarkerTest, PinsAndPathsStandInSpace) {
    window.inspector().pin({3, 2});
    window.inspector().pin({30, 20});
    ASSERT_TRUE(settle());
    EXPECT_TRUE(renderer.surfaces.empty()) << "nobody looks";
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return space().marks().pins.size() == 2; }, 60000));
    EXPECT_EQ(space().marks().pins[1].number, 2);
    EXPECT_EQ(space().marks().pins[1].place, renderer.surface->position);
    EXPECT_EQ(space().marks().pins[1].colour, widgets::pin_colour(1));
    const auto asked = renderer.surfaces.size();
    EXPECT_EQ(asked, 2u);
    EXPECT_NE(renderer.surfaces[0].asker, renderer.surfaces[1].asker);
    EXPECT_TRUE(space().marks().lines.empty());
    window.action("camera-key-add")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_FALSE(space().marks().lines.empty());
    emit window.inspector().panel().pins_cleared();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(space().marks().pins.empty());
}

TEST_F(SpaceMarkerTest, FliesToPinsAsOneStepAndThePinFollows) {
    EXPECT_FALSE(window.action("fly-to-pin")->isEnabled());
    window.inspector().pin({3, 2});
    const auto before = pose();
    const auto undo_steps = steps();
    QTest::keyClick(&window, Qt::Key_P, Qt::ShiftModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return pose().target == renderer.surface->position; }, 60000));
    EXPECT_LT(glm::length(pose().eye - pose().target), glm::length(before.eye - pose().target));
    EXPECT_EQ(steps(), undo_steps + 1);
    const auto size = window.session().experiment()->size;
    EXPECT_EQ(window.inspector().pins()[0], QPoint(size.x / 2, size.y / 2));
    trigger("undo");
    EXPECT_EQ(pose().eye, before.eye);
}

TEST_F(SpaceMarkerTest, ASphereOfDirectionsSaysThatNobodyFliesThere) {
    window.inspector().pin({3, 2});
    window.views().show_output("ball");
    ASSERT_TRUE(settle());
    const auto before = window.views().active_state();
    QTest::keyClick(&window, Qt::Key_P, Qt::ShiftModifier);
    ASSERT_TRUE(settle());
    EXPECT_NE(label("state").find("Pins stand in the scene"), std::string::npos) << label("state");
    EXPECT_EQ(window.views().active_state(), before);
}

TEST_F(SpaceMarkerTest, WhatShowsNoSurfaceOrLiesOutsideIsSaid) {
    const auto before = pose();
    renderer.surface.reset();
    window.inspector().pin({3, 2});
    window.inspector().pin({60000, 2});
    marker().fly_to(0);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return label("state").find("no surface") != std::string::npos; }, 60000));
    marker().fly_to(1);
    EXPECT_NE(label("state").find("outside"), std::string::npos) << label("state");
    renderer.surface_error = "nothing is rendered";
    marker().fly_to(0);
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return label("state").find("nothing is rendered") != std::string::npos; }, 60000));
    marker().fly_to(7);
    EXPECT_EQ(pose().eye, before.eye);
    EXPECT_FALSE(marker().place(owner(), {3, 2}));
}

TEST_F(SpaceMarkerTest, FromAPastFrameNobodyFliesThenOrLater) {
    window.inspector().pin({3, 2});
    ASSERT_TRUE(settle());
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_values(project, fake_registry(), owner(), {{"level", 0.5}});
    });
    window.session().end_gesture();
    ASSERT_TRUE(settle());
    const auto before = pose();
    window.live().past().show(0);
    ASSERT_TRUE(window.live().past().is_elsewhere());
    marker().fly_to(0);
    EXPECT_NE(label("state").find("newest frame"), std::string::npos) << label("state");
    // Nor is what it does not show keyed or lit.
    for (const char* action : {"camera-key-add", "headlight"}) window.action(action)->trigger();
    test::handle_events();
    EXPECT_TRUE(window.session().document().motion.empty());
    EXPECT_TRUE(window.session().document().lights.empty());
    EXPECT_TRUE(window.live().past().is_elsewhere());
    window.live().past().show_now();
    window.views().show_output("cloud");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space().marks().pins.empty(); }, 60000));
    EXPECT_EQ(pose().eye, before.eye);
    EXPECT_FALSE(space().is_free());
}

TEST_F(SpaceMarkerTest, InA3DViewItsOwnCameraFlies) {
    window.inspector().pin({3, 2});
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    const auto undo_steps = steps();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !space().marks().pins.empty(); }, 60000));
    marker().fly_to(0);
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), undo_steps) << "the document does not change";
    EXPECT_TRUE(space().is_free());
    EXPECT_EQ(space().pose().target, renderer.surface->position);
}

}  // namespace
}  // namespace ir::gui
