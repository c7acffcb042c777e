#include <gtest/gtest.h>

#include <QAction>
#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>
#include <QToolBar>
#include <QWheelEvent>
#include <cmath>

#include "tests/gui/events.h"
#include "tests/gui/widgets/space/fake_space.h"
#include "widgets/space/picture_pacer.h"
#include "widgets/space/space_camera.h"

namespace ir::widgets {
namespace {

using test::FakeSpace;
using test::in_view;
using test::place_of;

/// A shown view whose requests the fake answers at once, unless told to wait.
class SpaceViewTest : public testing::Test {
  protected:
    void SetUp() override {
        space_.experiment.eye = {0, 0, 4};
        QObject::connect(&view_, &SpaceView::view_wanted, &view_,
                         [this](const SpaceScene& scene, QSize size, int oversampling) {
                             wanted_.push_back(scene);
                             sizes_.push_back(size);
                             oversamplings_.push_back(oversampling);
                             if (answers_) view_.set_picture(space_.draw(scene, size));
                         });
        scene_.layers = {FakeSpace::layer()};
        view_.set_scene(scene_);
        view_.resize(480, 360);
        view_.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&view_));
        settle();
        ASSERT_FALSE(view_.picture().colour.empty());
    }
    void settle() {
        ir::test::handle_events();
        ASSERT_TRUE(
            QTest::qWaitFor([&] { return sizes_.size() > 0 && sizes_.back() == view_.wanted_size(); }));
    }
    QPoint middle() const { return view_.picture_area().center(); }
    void drag(Qt::MouseButton button, Qt::KeyboardModifiers keys, QPoint by) {
        QTest::mousePress(&view_, button, keys, middle());
        for (int i = 1; i <= 4; ++i) {
            const QPointF at = middle() + by * i / 4;
            QMouseEvent move(QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, button, keys);
            QApplication::sendEvent(&view_, &move);
        }
        QTest::mouseRelease(&view_, button, keys, middle() + by);
        ir::test::handle_events();
    }
    void wheel(QPointF at, int steps) {
        QWheelEvent event(at, view_.mapToGlobal(at), {}, {0, 120 * steps}, Qt::NoButton, Qt::NoModifier,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(&view_, &event);
    }
    QAction* action(const char* name) { return view_.findChild<QAction*>(QLatin1String(name)); }

    FakeSpace space_;
    SpaceScene scene_;
    SpaceView view_;
    bool answers_ = true;
    std::vector<SpaceScene> wanted_;
    std::vector<QSize> sizes_;
    std::vector<int> oversamplings_;
};

TEST_F(SpaceViewTest, AsksForPicturesOfItsSizeInDevicePixels) {
    const QSizeF area = view_.picture_area().size();
    EXPECT_EQ(sizes_.back(), (area * view_.devicePixelRatioF()).toSize());
    EXPECT_FALSE(wanted_.back().camera.has_value());
    EXPECT_FLOAT_EQ(wanted_.back().layers[0].size_px, float(3 * view_.devicePixelRatioF()));
    const std::size_t before = wanted_.size();
    view_.resize(400, 300);
    ASSERT_TRUE(QTest::qWaitFor([&] { return wanted_.size() > before; }));
    settle();
    EXPECT_EQ(QSize(view_.picture().colour.width, view_.picture().colour.height), view_.wanted_size());
}

TEST_F(SpaceViewTest, ADragOrbitsFromTheExperimentsCamera) {
    QSignalSpy changes(&view_, &SpaceView::scene_changed);
    EXPECT_FALSE(view_.is_free());
    EXPECT_TRUE(action("experiment_camera")->isChecked());
    const std::size_t before = wanted_.size();
    drag(Qt::LeftButton, {}, {60, 20});
    EXPECT_TRUE(view_.is_free());
    EXPECT_TRUE(action("free_camera")->isChecked());
    EXPECT_GT(wanted_.size(), before);
    ASSERT_TRUE(wanted_.back().camera.has_value());
    EXPECT_EQ(*wanted_.back().camera, view_.pose());
    EXPECT_EQ(view_.pose().target, space_.experiment.target);
    EXPECT_NEAR(glm::length(view_.pose().eye), 4, 1e-9);
    EXPECT_LT(view_.pose().eye.x, -0.3);  // the scene follows the hand
    EXPECT_EQ(changes.count(), 1);
}

TEST_F(SpaceViewTest, HomeReturnsToTheExperimentsCamera) {
    drag(Qt::LeftButton, {}, {60, 20});
    QTest::keyClick(&view_, Qt::Key_Home);
    ir::test::handle_events();
    EXPECT_FALSE(view_.is_free());
    EXPECT_FALSE(wanted_.back().camera.has_value());
    EXPECT_EQ(view_.pose(), space_.experiment);
    EXPECT_TRUE(action("experiment_camera")->isChecked());
}

TEST_F(SpaceViewTest, TheFreeCameraGoesOnFromTheExperiments) {
    action("free_camera")->trigger();
    EXPECT_TRUE(view_.is_free());
    EXPECT_EQ(view_.pose(), space_.experiment);
    action("experiment_camera")->trigger();
    EXPECT_FALSE(view_.is_free());
}

TEST_F(SpaceViewTest, ShiftSlidesAndCtrlLooksAround) {
    drag(Qt::LeftButton, Qt::ShiftModifier, {80, 0});
    EXPECT_LT(view_.pose().eye.x, -0.1);
    EXPECT_NEAR(view_.pose().eye.x, view_.pose().target.x, 1e-9);
    const glm::dvec3 eye = view_.pose().eye;
    drag(Qt::LeftButton, Qt::ControlModifier, {80, 0});
    EXPECT_EQ(view_.pose().eye, eye);
    EXPECT_GT(std::abs(view_.pose().target.x - eye.x), 0.1);
}

TEST_F(SpaceViewTest, AnElementThatIsSlidStaysUnderTheHand) {
    const QPointF start = place_of(view_.picture(), 0, 200);
    ASSERT_GE(start.x(), 0);
    const double z = 1 - 2 * 200.5 / 400;  // only points of the target's plane follow exactly
    ASSERT_LT(std::abs(z), 0.1);
    drag(Qt::LeftButton, Qt::ShiftModifier, {40, 20});
    const QPointF moved = (place_of(view_.picture(), 0, 200) - start) / view_.devicePixelRatioF();
    EXPECT_NEAR(moved.x(), 40, 14);
    EXPECT_NEAR(moved.y(), 20, 8);
}

TEST_F(SpaceViewTest, TheWheelGoesTowardsTheCursor) {
    const QRectF area = view_.picture_area();
    wheel(area.center(), 2);
    EXPECT_NEAR(view_.pose().eye.z, 4 / (1.15 * 1.15), 1e-9);
    EXPECT_NEAR(view_.pose().target.x, 0, 0.02);
    const double x = view_.pose().target.x;
    wheel(area.center() + QPointF(area.height() / 2, 0), 2);
    EXPECT_GT(view_.pose().target.x, x + 0.1);
    QSignalSpy changes(&view_, &SpaceView::scene_changed);
    EXPECT_TRUE(changes.wait(2000));
    EXPECT_EQ(changes.count(), 1);
}

TEST_F(SpaceViewTest, KeysFly) {
    QTest::keyPress(&view_, Qt::Key_W);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view_.pose().eye.z < 4; }));
    QTest::keyRelease(&view_, Qt::Key_W);
    EXPECT_LT(view_.pose().eye.z, 4);
    EXPECT_NEAR(view_.pose().eye.z - view_.pose().target.z, 4, 1e-9);
    EXPECT_TRUE(view_.is_free());
}

TEST_F(SpaceViewTest, ItsKeysGoBeforeShortcutsOfTheWindow) {
    QAction shortcut;
    shortcut.setShortcut(Qt::Key_F);
    shortcut.setShortcutContext(Qt::ApplicationShortcut);
    view_.addAction(&shortcut);
    QSignalSpy triggered(&shortcut, &QAction::triggered);
    view_.activateWindow();
    view_.setFocus();
    ASSERT_TRUE(QTest::qWaitFor([&] { return view_.hasFocus(); }));
    QTest::keyClick(&view_, Qt::Key_F);
    EXPECT_EQ(triggered.count(), 0);
    EXPECT_TRUE(view_.is_free());
}

TEST_F(SpaceViewTest, FramesWhatIsShown) {
    QTest::keyClick(&view_, Qt::Key_W);
    QTest::keyClick(&view_, Qt::Key_F);
    ir::test::handle_events();
    const CameraPose framed = view_.pose();
    EXPECT_EQ(framed.target, glm::dvec3(0));
    for (int i : {0, 100, 200, 399}) EXPECT_GE(place_of(view_.picture(), 0, i).x(), 0) << i;
    QTest::keyClick(&view_, Qt::Key_Home);
    QTest::mouseDClick(&view_, Qt::LeftButton, {}, middle());
    EXPECT_EQ(view_.pose().target, framed.target);
    EXPECT_NEAR(glm::length(view_.pose().eye), glm::length(framed.eye), 1e-6);
}

TEST_F(SpaceViewTest, OnlyOneRequestIsUnderWay) {
    answers_ = false;
    wanted_.clear();
    QTest::mousePress(&view_, Qt::LeftButton, {}, middle());
    const auto move = [&](int x) {
        const QPointF at = middle() + QPoint(x, 0);
        QMouseEvent event(QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
        QApplication::sendEvent(&view_, &event);
        QApplication::processEvents();
    };
    QElapsedTimer clock;
    clock.start();
    for (int x = 10; x <= 60; x += 10) move(x);
    // One more is right where the machine was so slow that the answer was overdue.
    const std::size_t overdue = std::size_t(clock.elapsed() / PicturePacer::patience_ms);
    EXPECT_LE(wanted_.size(), 1 + overdue);
    view_.set_picture(space_.draw(wanted_.back(), view_.wanted_size()));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !wanted_.empty() && wanted_.back().camera == view_.pose(); }));
    EXPECT_LE(wanted_.size(), 2 + overdue);  // the newest, not all between
    // Without an answer the next one follows after a while.
    move(70);
    EXPECT_TRUE(QTest::qWaitFor([&] { return wanted_.back().camera == view_.pose(); }, 60000));
    QTest::mouseRelease(&view_, Qt::LeftButton, {}, middle() + QPoint(70, 0));
    EXPECT_FALSE(view_.picture().colour.empty());  // never blank
}

TEST_F(SpaceViewTest, SlowPicturesAreCoarseOnlyWhileTheCameraMoves) {
    answers_ = false;
    view_.refresh();
    wanted_.clear();
    ASSERT_TRUE(QTest::qWaitFor([&] { return wanted_.size() == 1; }));
    QTest::qWait(150);  // so long the picture takes
    view_.set_picture(space_.draw(wanted_.back(), sizes_.back()));
    const QSize full = view_.wanted_size();
    QTest::mousePress(&view_, Qt::LeftButton, {}, middle());
    const QPointF at = middle() + QPoint(50, 0);
    QMouseEvent event(QEvent::MouseMove, at, view_.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&view_, &event);
    ASSERT_TRUE(QTest::qWaitFor([&] { return wanted_.size() == 2; }));
    EXPECT_EQ(sizes_.back(), QSize(full.width() / 2, full.height() / 2));
    view_.set_picture(space_.draw(wanted_.back(), sizes_.back()));
    QTest::mouseRelease(&view_, Qt::LeftButton, {}, middle() + QPoint(50, 0));
    ASSERT_TRUE(QTest::qWaitFor([&] { return wanted_.size() == 3; }));
    EXPECT_EQ(sizes_.back(), full);
}

TEST_F(SpaceViewTest, APictureThatStandsStillBecomesSmoothOnce) {
    if (view_.devicePixelRatioF() >= 1.5) GTEST_SKIP() << "fine screens need no smoother edges";
    EXPECT_EQ(oversamplings_.back(), 1);
    ASSERT_TRUE(QTest::qWaitFor([&] { return oversamplings_.back() == 2; }, 60000));
    const std::size_t count = wanted_.size();
    const auto* refine = view_.findChild<QTimer*>(QString(), Qt::FindDirectChildrenOnly);
    ASSERT_TRUE(refine);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !refine->isActive(); }, 60000)) << "another one is to come";
    EXPECT_EQ(wanted_.size(), count);
    drag(Qt::LeftButton, {}, {30, 0});
    EXPECT_EQ(oversamplings_.back(), 1);
    EXPECT_TRUE(QTest::qWaitFor([&] { return oversamplings_.back() == 2; }, 60000));
}

TEST_F(SpaceViewTest, AClickPicksTheElementUnderIt) {
    QSignalSpy clicks(&view_, &SpaceView::element_clicked);
    int picked = 0;
    for (int element : {17, 123, 250, 399}) {
        const QPointF at = place_of(view_.picture(), 0, element);
        if (at.x() < 0) continue;  // hidden by another one
        ++picked;
        QTest::mouseClick(&view_, Qt::LeftButton, {}, in_view(view_, at));
        ASSERT_EQ(clicks.count(), picked);
        EXPECT_EQ(clicks.last()[0].toInt(), 0);
        EXPECT_EQ(clicks.last()[1].toLongLong(), element);
    }
    EXPECT_GE(picked, 2);
    QTest::mouseClick(&view_, Qt::LeftButton, {}, view_.picture_area().topLeft() + QPoint(4, 4));
    EXPECT_EQ(clicks.last()[0].toInt(), -1);
    EXPECT_FALSE(view_.is_free());  // a click moves nothing
}

TEST_F(SpaceViewTest, HoversTellTheElementAndWhatAClickChooses) {
    view_.set_selectors({{.key = "layer", .label = "Map", .count = 3}});
    QSignalSpy hovers(&view_, &SpaceView::element_hovered);
    const QPoint at = in_view(view_, place_of(view_.picture(), 0, 250));
    QTest::mouseMove(&view_, at);
    ASSERT_TRUE(QTest::qWaitFor([&] { return hovers.count() > 0 && hovers.last()[1].toLongLong() == 250; }));
    const QImage plain = view_.grab().toImage();
    view_.set_hover_values(QStringLiteral("depth 0.25 m"));
    EXPECT_NE(view_.grab().toImage(), plain);
}

TEST_F(SpaceViewTest, HiddenLayersShiftNoClicks) {
    SpaceLayer hidden = FakeSpace::layer();
    hidden.key = "other";
    hidden.visible = false;
    view_.set_layers({hidden, FakeSpace::layer()});
    ir::test::handle_events();
    EXPECT_EQ(view_.element_at(in_view(view_, place_of(view_.picture(), 0, 250))), (SpaceElement{1, 250}));
}

TEST_F(SpaceViewTest, TheLegendIsOfThePictureThatIsShown) {
    QSignalSpy shown(&view_, &SpaceView::picture_shown);
    answers_ = false;
    const QImage before = view_.snapshot(true);
    SpaceLayer layer = FakeSpace::layer();
    layer.colour_by = "depth";
    view_.set_layers({layer});
    ir::test::handle_events();
    EXPECT_EQ(view_.snapshot(true), before);  // still coloured by layer, and says so
    view_.set_picture(space_.draw(wanted_.back(), view_.wanted_size()));
    EXPECT_NE(view_.snapshot(true), before);
    EXPECT_EQ(view_.picture().layers[0].requested.colour_by, "depth");
    EXPECT_EQ(shown.count(), 1);
    // An answer that names its question is read as that, however late it comes.
    SpacePicture late = space_.draw(scene_, view_.wanted_size());
    late.scene = std::make_shared<SpaceScene>(scene_);
    view_.set_picture(std::move(late));
    EXPECT_EQ(view_.picture().layers[0].requested.colour_by, "layer");
}

TEST_F(SpaceViewTest, ANoteLeavesTheOldPicture) {
    const QImage before = view_.snapshot(false);
    view_.set_note(QStringLiteral("The device is busy."));
    EXPECT_EQ(view_.snapshot(false), before);
    EXPECT_NE(view_.snapshot(true), before);
    view_.clear(QStringLiteral("Another experiment."));
    EXPECT_NE(view_.snapshot(false), before);
    EXPECT_TRUE(view_.picture().colour.empty());
}

TEST_F(SpaceViewTest, SnapshotsAreWhatIsSeen) {
    const QImage shot = view_.snapshot(false);
    EXPECT_EQ(shot.size(), view_.wanted_size());
    const QPoint at = place_of(view_.picture(), 0, 250).toPoint();
    const QImage seen = view_.grab().toImage();
    const QPoint origin = view_.picture_area().topLeft() * view_.devicePixelRatioF();
    EXPECT_EQ(seen.pixelColor(at + origin), shot.pixelColor(at));
    EXPECT_NE(shot.pixelColor(at), surround_colour);
    EXPECT_EQ(shot.pixelColor(2, 2), surround_colour);
}

TEST_F(SpaceViewTest, ASphereIsSeenFromOutside) {
    SpaceLayer sphere = default_layer(FakeSpace::directions());
    EXPECT_EQ(sphere.colour_by, "accessibility");
    view_.set_layers({sphere});
    ir::test::handle_events();
    ASSERT_TRUE(wanted_.back().camera.has_value());
    EXPECT_EQ(view_.pose().target, glm::dvec3(0));
    EXPECT_FALSE(action("experiment_camera")->isEnabled());
    EXPECT_FALSE(action("show_scene")->isVisible());
    EXPECT_TRUE(action("show_centres")->isVisible());
    drag(Qt::LeftButton, {}, {40, 0});
    wheel(view_.picture_area().center(), 40);
    ir::test::handle_events();
    EXPECT_NEAR(glm::length(view_.pose().eye), 1.3, 1e-9);
    EXPECT_FALSE(view_.is_free());  // the scene's camera stays what it was
    view_.set_layers({FakeSpace::layer()});
    ir::test::handle_events();
    EXPECT_FALSE(wanted_.back().camera.has_value());
}

TEST_F(SpaceViewTest, ASpaceOfItsOwnHasNeitherSceneNorExperimentsCamera) {
    space_.fields = {{"place", FieldType::f32, 3}};
    view_.refresh();
    ir::test::handle_events();
    EXPECT_FALSE(action("show_scene")->isVisible());
    EXPECT_EQ(action("experiment_camera")->text(), "From the front");
    drag(Qt::LeftButton, {}, {40, 0});
    EXPECT_TRUE(view_.is_free()) << "it can be orbited all the same";
    QTest::keyClick(&view_, Qt::Key_F);
    ir::test::handle_events();
    EXPECT_FALSE(wanted_.back().camera.has_value()) << "the renderer knows how large it is";
    space_.fields = FakeSpace::buffer().fields;
    view_.refresh();
    ir::test::handle_events();
    EXPECT_TRUE(action("show_scene")->isVisible());
}

TEST_F(SpaceViewTest, ASphereFitsTheSmallerSide) {
    view_.set_layers({default_layer(FakeSpace::directions())});
    for (const QSize size : {QSize(480, 360), QSize(240, 640)}) {
        view_.resize(size);
        settle();
        ASSERT_EQ(sizes_.back(), view_.wanted_size());
        const CameraPose& pose = wanted_.back().camera.value();
        const double aspect = std::min(1.0, double(sizes_.back().width()) / sizes_.back().height());
        const double half = std::tan(glm::radians(pose.fov_y_degrees / 2));
        const double of_sphere = std::tan(std::asin(1 / glm::length(pose.eye)));
        EXPECT_LT(of_sphere, half * aspect) << "nothing is cut off";
        EXPECT_GT(of_sphere, 0.8 * half * aspect) << "and it fills the view";
    }
}

TEST_F(SpaceViewTest, ASphereStandsBelowItsLegend) {
    view_.set_layers({default_layer(FakeSpace::directions())});
    view_.resize(480, 130);
    settle();
    const CameraPose& pose = wanted_.back().camera.value();
    const auto axes = camera_axes(pose);
    const double half = std::tan(glm::radians(pose.fov_y_degrees / 2));
    const double middle = std::atan(glm::dot(-pose.eye, axes.up) / glm::dot(-pose.eye, axes.forward));
    const double of_sphere = std::asin(1 / glm::length(pose.eye));
    const double height = view_.picture_area().height();
    const double top = (1 - std::tan(middle + of_sphere) / half) / 2 * height;
    const double bottom = (1 - std::tan(middle - of_sphere) / half) / 2 * height;
    const double strip = legend_strip(1, view_.picture_area().size());
    EXPECT_GT(strip, 0);
    EXPECT_GE(top, strip);
    EXPECT_LE(bottom, height);
    EXPECT_GT(bottom - top, 0.8 * (height - strip));
}

TEST_F(SpaceViewTest, TicksAskForThePicture) {
    QSignalSpy changes(&view_, &SpaceView::scene_changed);
    action("show_scene")->trigger();
    ir::test::handle_events();
    EXPECT_FALSE(wanted_.back().show_scene);
    EXPECT_EQ(changes.count(), 1);
}

TEST_F(SpaceViewTest, AsksForNothingWhileHidden) {
    view_.hide();
    wanted_.clear();
    view_.refresh();
    ir::test::handle_events();
    EXPECT_TRUE(wanted_.empty());
    view_.show();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !wanted_.empty(); }));
}

}  // namespace
}  // namespace ir::widgets
