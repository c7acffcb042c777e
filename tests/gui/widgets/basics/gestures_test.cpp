// What the mouse, the wheel and keys do to a picture and to its camera.
#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "tests/gui/events.h"
#include "tests/gui/widgets/surfaces.h"
#include "widgets/image/image_view.h"

namespace ir::widgets {
namespace {

TEST(ImageView, WheelZoomsAboutTheCursor) {
    ImageView view;
    view.set_picture(make_picture(Image(100, 100, 1), Semantic::generic));
    show(view);
    const QPointF cursor(200, 90);
    const QPointF before = view.transform().image_from_view(cursor * view.devicePixelRatio());
    const double zoom = view.transform().zoom();
    QWheelEvent wheel(cursor, view.mapToGlobal(cursor), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view, &wheel);
    EXPECT_NEAR(view.transform().zoom(), zoom * 1.25 * 1.25, 1e-9);
    const QPointF after = view.transform().image_from_view(cursor * view.devicePixelRatio());
    EXPECT_NEAR(after.x(), before.x(), 0.5 / view.transform().zoom() + 1e-9);
    EXPECT_NEAR(after.y(), before.y(), 0.5 / view.transform().zoom() + 1e-9);
}

TEST(ImageView, AnOrbitIsOneGestureAndKeepsTheTarget) {
    ImageView view;
    view.set_picture(make_picture(Image(8, 8, 3), Semantic::radiance));
    show(view);
    CameraPose start;
    view.camera().set_pose(start);
    view.set_tool(ImageView::Tool::orbit);
    QSignalSpy moves(&view, &ImageView::camera_moved), ends(&view, &ImageView::camera_gesture_finished);
    QTest::mousePress(&view, Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(&view, {120, 100});
    QTest::mouseMove(&view, {140, 110});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {140, 110});
    EXPECT_GE(moves.count(), 1);
    EXPECT_EQ(ends.count(), 1);
    EXPECT_EQ(view.camera().pose().target, start.target);
    EXPECT_NE(view.camera().pose().eye, start.eye);
    EXPECT_NEAR(glm::length(view.camera().pose().eye - view.camera().pose().target), 5, 1e-9);
}

TEST(ImageView, InspectingNeverMovesTheCamera) {
    ImageView view;
    view.set_picture(make_picture(Image(8, 8, 3), Semantic::radiance));
    show(view);
    QSignalSpy moves(&view, &ImageView::camera_moved), picks(&view, &ImageView::picked_changed);
    QTest::mousePress(&view, Qt::LeftButton, {}, {100, 100});
    QTest::mouseMove(&view, {180, 150});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {180, 150});
    EXPECT_EQ(moves.count(), 0);
    EXPECT_EQ(picks.count(), 0);
    const QPointF at = view.transform().view_from_image({2.5, 3.5});
    QTest::mouseClick(&view, Qt::LeftButton, {}, at.toPoint() / view.devicePixelRatio());
    EXPECT_EQ(view.state().marks.picked, QPoint(2, 3));
}

TEST(ImageView, KeysFlyTheCamera) {
    ImageView view;
    view.set_picture(make_picture(Image(8, 8, 3), Semantic::radiance));
    show(view);
    view.camera().set_pose({});
    view.set_tool(ImageView::Tool::fly);
    QSignalSpy ends(&view, &ImageView::camera_gesture_finished);
    QTest::keyPress(&view, Qt::Key_W);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view.camera().pose().eye.z < 5; }));
    QTest::keyRelease(&view, Qt::Key_W);
    EXPECT_LT(view.camera().pose().eye.z, 5);
    EXPECT_DOUBLE_EQ(view.camera().pose().eye.x, 0);
    EXPECT_TRUE(ends.wait(2000));
}

TEST(ViewTransform, AnotherResolutionKeepsTheRegion) {
    ViewTransform t;
    t.set_view_size({400, 400});
    t.set_image_size({100, 100});
    t.look_at({25, 75}, 16);
    t.set_image_size({50, 50});
    EXPECT_DOUBLE_EQ(t.zoom(), 32);
    EXPECT_NEAR(t.centre().x(), 12.5, 1 / t.zoom());
    EXPECT_NEAR(t.centre().y(), 37.5, 1 / t.zoom());
}

TEST(CameraMotion, OrbitStopsBeforeThePole) {
    CameraPose pose;
    pose = orbited(pose, 0, 10);
    EXPECT_NEAR(glm::length(pose.eye), 5, 1e-9);
    EXPECT_GT(pose.eye.y, 4.99);
    EXPECT_GT(glm::length(glm::cross(glm::normalize(pose.target - pose.eye), pose.up)), 0.005);
}

TEST(CameraMotion, LookingTurnsTheTargetAboutTheEye) {
    const CameraPose pose = looked({}, glm::radians(90.0), 0);
    EXPECT_EQ(pose.eye, glm::dvec3(0, 0, 5));
    EXPECT_NEAR(pose.target.x, -5, 1e-9);
    EXPECT_NEAR(pose.target.z, 5, 1e-9);
}

TEST(CameraMotion, SlidingByOneMovesByThePictureHeight) {
    CameraPose pose;
    pose.fov_y_degrees = 90;
    EXPECT_NEAR(slid(pose, 1, 0).eye.x, 10, 1e-9);
    EXPECT_NEAR(slid(pose, 0, 1).target.y, 10, 1e-9);
}

}  // namespace
}  // namespace ir::widgets
