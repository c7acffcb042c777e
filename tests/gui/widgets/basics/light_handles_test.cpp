#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <set>

#include "widgets/image/decimals.h"
#include "widgets/image/image_view.h"
#include "widgets/image/legend.h"

namespace ir::widgets {
namespace {

using enum LightHandle;

CameraPose camera_in_front() {
    CameraPose pose;
    pose.eye = {0.3, 0.4, 6};
    pose.target = {0, 0, 0};
    return pose;
}

PlacedLight spot() {
    PlacedLight light;
    light.shape = PlacedLight::Shape::cone;
    light.name = "Spot";
    light.position = {0.5, 0.25, 1};
    light.direction = glm::normalize(glm::dvec3(0.2, -1, 0.4));
    return light;
}

Sight sight_at(const CameraPose& camera, const glm::dvec3& point) {
    return sight_through(camera, 1.5, *place_of(camera, 1.5, point));
}

TEST(LightHandles, ADragBeginsWhereTheLightIs) {
    for (const bool orthographic : {false, true}) {
        auto camera = camera_in_front();
        camera.orthographic = orthographic;
        for (const auto handle : {centre, x, y, z, direction}) {
            LightDrag drag(spot(), handle, camera, 0.4);
            const auto light = drag.to(sight_at(camera, end_of(spot(), handle, 0.4)));
            EXPECT_NEAR(glm::length(light.position - spot().position), 0, 1e-9);
            EXPECT_NEAR(glm::length(light.direction - spot().direction), 0, 1e-6);
        }
    }
}

TEST(LightHandles, AnAxisMovesAlongItselfToWhatIsUnderTheCursor) {
    const auto camera = camera_in_front();
    const glm::dvec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const LightHandle handles[] = {x, y, z};
    for (int i = 0; i < 3; ++i) {
        LightDrag drag(spot(), handles[i], camera, 0.4);
        const auto end = end_of(spot(), handles[i], 0.4) + 0.7 * axes[i];
        const auto light = drag.to(sight_at(camera, end));
        EXPECT_NEAR(glm::length(light.position - (spot().position + 0.7 * axes[i])), 0, 1e-9);
        // Off the axis it stays on it.
        const auto beside = drag.to(sight_at(camera, end + 0.2 * axes[(i + 1) % 3]));
        EXPECT_NEAR(glm::length(glm::cross(beside.position - spot().position, axes[i])), 0, 1e-9);
    }
}

TEST(LightHandles, TheCentreMovesParallelToThePicture) {
    const auto camera = camera_in_front();
    LightDrag drag(spot(), centre, camera, 0.4);
    const auto axes = camera_axes(camera);
    const auto wanted = spot().position + 0.3 * axes.right - 0.6 * axes.up;
    EXPECT_NEAR(glm::length(drag.to(sight_at(camera, wanted)).position - wanted), 0, 1e-9);
}

/// Where the line of sight runs along the axis, no place on it is nearer than the others.
TEST(LightHandles, AnAxisThatPointsAtTheEyeDoesNotJump) {
    CameraPose camera;
    camera.eye = {0, 0, 5};
    auto light = spot();
    light.position = {0, 0, 0};
    for (const bool orthographic : {false, true}) {
        camera.orthographic = orthographic;
        LightDrag drag(light, z, camera, 0.4);
        for (const double off : {0.0, 1e-12, 1e-6, 1e-3, 5e-3}) {
            const auto moved = drag.to(sight_through(camera, 1.5, {0.5 + off, 0.5})).position;
            ASSERT_TRUE(std::isfinite(moved.z)) << off;
            EXPECT_LT(glm::length(moved), orthographic ? 1e-9 : 6) << off;
        }
    }
    // Neither towards the vanishing point of an axis, nor behind the eye.
    camera = camera_in_front();
    LightDrag drag(spot(), x, camera, 0.4);
    glm::dvec3 before = spot().position;
    for (double place = 0.5; place < 40; place *= 1.1) {
        const auto now = drag.to(sight_through(camera, 1.5, {place, 0.45})).position;
        ASSERT_TRUE(std::isfinite(now.x));
        EXPECT_LE(glm::length(now - spot().position), 100 * height_at(camera, spot().position));
        EXPECT_TRUE(place_of(camera, 1.5, now)) << "in front of the camera";
        before = now;
    }
}

TEST(LightHandles, ADirectionFollowsTheCursorAndRollsOverTheEdge) {
    CameraPose camera;
    camera.eye = {0, 0, 5};
    camera.orthographic = true;
    auto light = spot();
    light.position = {0, 0, 0};
    light.direction = glm::normalize(glm::dvec3(0.3, 0, 1));  // towards the camera
    LightDrag drag(light, direction, camera, 0.5);
    const double radius = glm::length(end_of(light, direction, 0.5));
    const auto at = [&](double x) { return drag.to({{x * radius, 0, 5}, {0, 0, -1}}).direction; };
    EXPECT_NEAR(glm::length(at(0.6) - glm::dvec3(0.6, 0, 0.8)), 0, 1e-9);
    EXPECT_NEAR(at(1.5).x, 1, 1e-9);
    EXPECT_NEAR(at(1.2).x, 1, 1e-9) << "beyond the edge it stays on it";
    EXPECT_NEAR(glm::length(at(0.6) - glm::dvec3(0.6, 0, -0.8)), 0, 1e-9) << "the other side";
    EXPECT_NEAR(at(0.999).z, -std::sqrt(1 - 0.999 * 0.999), 1e-9);
    EXPECT_NEAR(at(-1.1).x, -1, 1e-9);
    EXPECT_NEAR(glm::length(at(-0.6) - glm::dvec3(-0.6, 0, 0.8)), 0, 1e-9) << "and back";
}

TEST(LightHandles, NudgesAreParallelToThePictureAndTurnsKeepTheLength) {
    const auto camera = camera_in_front();
    const auto axes = camera_axes(camera);
    const double height = height_at(camera, spot().position);
    const auto moved = nudged(spot(), camera, {0.01, -0.02, 0.03});
    EXPECT_NEAR(glm::length(moved.position - spot().position -
                            height * (0.01 * axes.right - 0.02 * axes.up + 0.03 * axes.forward)),
                0, 1e-12);
    auto head = spot();
    head.position = camera.eye;
    EXPECT_GT(glm::length(nudged(head, camera, {0.01, 0, 0}).position - camera.eye), 0.01) << "not seen";
    const auto round = turned(spot(), camera, 0.2, 0.1);
    EXPECT_NEAR(glm::length(round.direction), 1, 1e-12);
    EXPECT_GT(glm::length(round.direction - spot().direction), 0.05);
}

TEST(LightHandles, OutlinesAreAsLargeAsTheLight) {
    auto light = spot();
    light.direction = {0, -1, 0};
    light.shape = PlacedLight::Shape::rectangle;
    light.size = {2, 0.5};
    const auto corners = outline_of(light, 1);
    ASSERT_EQ(corners.size(), 4u);
    EXPECT_NEAR(glm::length(corners[1] - corners[0]), 2, 1e-9);
    EXPECT_NEAR(std::abs(corners[1].x - corners[0].x), 2, 1e-9) << "width along x, as renderers have it";
    EXPECT_NEAR(glm::length(corners[2] - corners[1]), 0.5, 1e-9);
    light.shape = PlacedLight::Shape::cone;
    light.half_angle = 30;
    for (const auto& rim : outline_of(light, 1))
        EXPECT_NEAR(glm::dot(rim - light.position, light.direction), std::cos(glm::radians(30.0)), 1e-9);
}

class LightToolTest : public testing::Test {
  protected:
    void SetUp() override {
        view.resize(600, 400);
        Picture picture;
        picture.image = std::make_shared<Image>(60, 40, 3, 0.5f);
        view.set_picture(std::make_shared<const Picture>(picture));
        view.camera().set_pose(camera_in_front());
        view.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
        view.set_light(spot());
        QObject::connect(&view, &ImageView::light_moved, &view, [this](const glm::dvec3& position) {
            auto light = *view.state().light;
            light.position = position;
            view.set_light(light);
        });
        QObject::connect(&view, &ImageView::light_turned, &view, [this](const glm::dvec3& to) {
            auto light = *view.state().light;
            light.direction = to;
            view.set_light(light);
        });
    }
    QPoint place(LightHandle handle) {
        const qreal ratio = view.devicePixelRatioF();
        const auto& light = *view.state().light;
        return (*seen_at(view.state(), end_of(light, handle, handle_length(view.state(), ratio))) / ratio)
            .toPoint();
    }
    const PlacedLight& light() { return *view.state().light; }

    ImageView view{nullptr, ImageView::Surface::raster};
};

TEST_F(LightToolTest, AHandleIsDraggedWhateverTheToolIs) {
    QSignalSpy finished(&view, &ImageView::light_gesture_finished), picked(&view, &ImageView::picked_changed),
        posed(&view, &ImageView::camera_moved), explained(&view, &ImageView::explain_wanted);
    const auto zoom = view.transform().offset();
    for (const auto tool : {ImageView::Tool::inspect, ImageView::Tool::orbit, ImageView::Tool::rectangle}) {
        view.set_tool(tool);
        view.set_light(spot());
        const auto from = place(x);
        QTest::mouseMove(&view, {20, 20});
        QTest::mouseMove(&view, from + QPoint(1, 0));
        EXPECT_TRUE(QTest::qWaitFor([&] { return view.state().light_handle == x; }));
        EXPECT_TRUE(view.state().hint.contains("along x"));
        QTest::mousePress(&view, Qt::LeftButton, {}, from);
        for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view, from + QPoint(10 * i, 0));
        QTest::mouseRelease(&view, Qt::LeftButton, Qt::ShiftModifier, from + QPoint(50, 0));
        EXPECT_GT(light().position.x, spot().position.x + 0.3);
        EXPECT_DOUBLE_EQ(light().position.y, spot().position.y);
        EXPECT_DOUBLE_EQ(light().position.z, spot().position.z);
        EXPECT_LE((place(x) - (from + QPoint(50, 0))).manhattanLength(), 3) << "under the cursor";
    }
    EXPECT_EQ(finished.count(), 3);
    EXPECT_EQ(picked.count(), 0);
    EXPECT_EQ(posed.count(), 0);
    EXPECT_EQ(explained.count(), 0);
    EXPECT_TRUE(view.state().marks.region.isEmpty());
    EXPECT_EQ(view.transform().offset(), zoom);
}

TEST_F(LightToolTest, EscapeTakesADragBackAndItsReleaseDoesNothing) {
    QSignalSpy finished(&view, &ImageView::light_gesture_finished), picked(&view, &ImageView::picked_changed);
    const auto from = place(direction);
    QTest::mousePress(&view, Qt::LeftButton, {}, from);
    QTest::mouseMove(&view, from + QPoint(20, -30));
    EXPECT_NE(light().direction, spot().direction);
    QTest::keyClick(&view, Qt::Key_Escape);
    ASSERT_EQ(finished.count(), 1);
    EXPECT_FALSE(finished[0][0].toBool());
    const auto now = light();
    QTest::mouseMove(&view, from + QPoint(60, -30));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, from + QPoint(60, -30));
    EXPECT_EQ(light(), now);
    EXPECT_EQ(finished.count(), 1);
    EXPECT_EQ(picked.count(), 0);
}

TEST_F(LightToolTest, ArrowsNudgeAndTurn) {
    QSignalSpy finished(&view, &ImageView::light_gesture_finished);
    view.setFocus();
    const auto axes = camera_axes(camera_in_front());
    const auto gone = [&](Qt::Key key, Qt::KeyboardModifiers modifiers) {
        view.set_light(spot());
        QTest::keyClick(&view, key, modifiers);
        return light().position - spot().position;
    };
    EXPECT_GT(glm::dot(gone(Qt::Key_Right, Qt::NoModifier), axes.right), 0.01);
    EXPECT_GT(glm::dot(gone(Qt::Key_Up, Qt::NoModifier), axes.up), 0.01);
    EXPECT_NEAR(glm::dot(gone(Qt::Key_Up, Qt::ShiftModifier), axes.up) /
                    glm::dot(gone(Qt::Key_Up, Qt::NoModifier), axes.up),
                10, 0.5);
    EXPECT_GT(glm::dot(gone(Qt::Key_Up, Qt::ControlModifier), axes.forward), 0.01);
    QTest::mouseMove(&view, {20, 20});
    QTest::mouseMove(&view, place(centre));
    ASSERT_TRUE(QTest::qWaitFor([&] { return view.state().hint.contains("nudge"); }));
    gone(Qt::Key_Right, Qt::NoModifier);
    QTest::mouseMove(&view, {20, 20});
    EXPECT_TRUE(QTest::qWaitFor([&] { return view.state().hint.isEmpty(); })) << "the cursor left it";
    EXPECT_EQ(gone(Qt::Key_Left, Qt::AltModifier), glm::dvec3(0));
    EXPECT_NE(light().direction, spot().direction);
    EXPECT_EQ(finished.count(), 7);
    EXPECT_TRUE(view.accessibleDescription().contains("Spot"));
}

TEST_F(LightToolTest, AHandLeavesNoMoreDecimalsThanAreSeen) {
    view.setFocus();
    const double height = height_at(camera_in_front(), spot().position);
    ASSERT_TRUE(height > 1 && height < 10) << "so that millimetres are less than a pixel";
    const auto are_few = [](const glm::dvec3& v) {
        return glm::all(glm::lessThan(glm::abs(1000.0 * v - glm::round(1000.0 * v)), glm::dvec3(1e-9)));
    };
    auto odd = spot();
    odd.position = {0.123456, 0.25, 1};
    view.set_light(odd);
    const auto from = place(y);
    QTest::mousePress(&view, Qt::LeftButton, {}, from);
    for (int i = 1; i <= 5; ++i) QTest::mouseMove(&view, from - QPoint(0, 7 * i));
    QTest::mouseRelease(&view, Qt::LeftButton);
    EXPECT_GT(light().position.y, 0.3);
    EXPECT_EQ(light().position.x, 0.123456) << "what did not move keeps what was typed";
    QTest::keyClick(&view, Qt::Key_Right, Qt::ShiftModifier);
    QTest::keyClick(&view, Qt::Key_Up, Qt::ControlModifier);
    EXPECT_TRUE(are_few(light().position)) << light().position.x << ' ' << light().position.z;
    QTest::keyClick(&view, Qt::Key_Left, Qt::AltModifier);
    EXPECT_TRUE(are_few(light().direction)) << light().direction.x;
    EXPECT_EQ(in_decimals(0.30000001, 2), 0.3);
    EXPECT_EQ(in_decimals(1234567, 8e6), 1235000);
    EXPECT_EQ(in_decimals(0.5, 0), 0.5);
}

TEST_F(LightToolTest, ALightAtTheCameraSaysHowToBringItIntoSight) {
    view.setFocus();
    EXPECT_TRUE(view.state().hint.isEmpty());
    auto light_of_camera = spot();
    light_of_camera.position = camera_in_front().eye;
    view.set_light(light_of_camera);
    EXPECT_TRUE(view.state().hint.contains("Spot: at the camera"));
    EXPECT_TRUE(view.state().hint.contains(QStringLiteral("Ctrl+↑")));
    QTest::keyClick(&view, Qt::Key_Up, Qt::ControlModifier);
    EXPECT_TRUE(seen_at(view.state(), light().position)) << "as the hint promises";
    EXPECT_TRUE(view.state().hint.isEmpty());
    view.set_light(light_of_camera);
    view.camera().set_pose(orbited(camera_in_front(), 0.5, 0));
    EXPECT_FALSE(view.state().hint.contains("behind")) << "the camera moved and sees it";
    view.camera().set_pose(dollied(camera_in_front(), 0.5));
    EXPECT_TRUE(view.state().hint.contains("behind"));
    view.set_light({});
    EXPECT_TRUE(view.state().hint.isEmpty());
}

TEST_F(LightToolTest, HandlesFollowTheCameraAndKeepTheirLength) {
    const auto length = [&] {
        const QPointF along = place(x) - place(centre);
        return std::hypot(along.x(), along.y());
    };
    const auto before = place(centre);
    const double is_long = length();
    view.camera().set_pose(dollied(camera_in_front(), 3));
    EXPECT_NE(place(centre), before);
    EXPECT_NEAR(length(), is_long, 8);
    view.camera().set_pose(looked(camera_in_front(), 3, 0));  // it is behind the camera
    EXPECT_FALSE(seen_at(view.state(), light().position));
    QTest::mouseMove(&view, {300, 200});
    EXPECT_EQ(view.state().light_handle, none);
    view.grab();
}

/// So that each axis and the light's direction in turn point at the camera.
TEST_F(LightToolTest, WhatPointsAtTheCameraHidesNoOtherHandle) {
    const auto look_along = [&](const glm::dvec3& forward) {
        CameraPose pose;
        pose.target = spot().position;
        pose.eye = pose.target - 5.0 * forward;
        view.camera().set_pose(pose);
    };
    const auto holds = [&](QPoint position, LightHandle handle) {
        QTest::mouseMove(&view, {20, 20});
        QTest::mouseMove(&view, position);
        return QTest::qWaitFor([&] { return view.state().light_handle == handle; });
    };
    look_along({0, 0, -1});
    EXPECT_FALSE(grip_of(view.state(), z, view.devicePixelRatioF())) << "neither drawn nor held";
    EXPECT_TRUE(holds(place(centre), centre));
    EXPECT_TRUE(holds(place(x), x));
    EXPECT_TRUE(holds(place(direction), direction));
    for (const double side : {1.0, -1.0}) {
        SCOPED_TRACE(side);
        look_along(side * spot().direction);
        const auto grip = grip_of(view.state(), direction, view.devicePixelRatioF());
        ASSERT_TRUE(grip);
        ASSERT_GT(grip->ring, 0);
        const int ring = int(grip->ring / view.devicePixelRatioF());
        EXPECT_TRUE(holds(place(centre), centre));
        const auto from = place(centre) - QPoint(ring, 0);
        EXPECT_TRUE(holds(from, direction));
        QTest::mousePress(&view, Qt::LeftButton, {}, from);
        QTest::mouseMove(&view, from - QPoint(15, 0));
        QTest::mouseMove(&view, from - QPoint(40, 0));
        QTest::mouseRelease(&view, Qt::LeftButton, {}, from - QPoint(40, 0));
        EXPECT_GT(glm::length(light().direction - spot().direction), 0.3);
        EXPECT_EQ(grip_of(view.state(), direction, 1)->ring, 0);
        view.set_light(spot());
    }
}

TEST_F(LightToolTest, NoLineCrossesTheMiddle) {
    const QImage seen = view.grab().toImage();
    const auto middle = place(centre) * seen.devicePixelRatio();
    std::set<QRgb> colours;
    for (int row = -2; row <= 2; ++row)
        for (int column = -2; column <= 2; ++column) colours.insert(seen.pixel(middle + QPoint(column, row)));
    EXPECT_EQ(colours.size(), 1u);
    view.set_light({});
    EXPECT_EQ(colours.count(view.grab().toImage().pixel(middle)), 0u) << "it is the centre's dot";
}

TEST_F(LightToolTest, NorDoesASunsLine) {
    auto sun = spot();
    sun.shape = PlacedLight::Shape::sun;
    view.set_light(sun);
    const auto middle = seen_at(view.state(), light().position)->toPoint();
    EXPECT_LT(qGray(view.grab().toImage().pixel(middle)), 60) << "dark, not the line's yellow";
}

TEST_F(LightToolTest, HandlesStayInASmallView) {
    view.resize(180, 150);
    ASSERT_TRUE(QTest::qWaitFor([&] { return view.state().transform.view_size().width() < 400; }));
    const double ratio = view.devicePixelRatioF();
    const auto along = place(x) - place(centre);
    EXPECT_LE(std::hypot(along.x(), along.y()), 31);
    EXPECT_GE(std::hypot(along.x(), along.y()) * ratio, 18) << "long enough to be held";
}

TEST(LightHint, IsWrappedBetweenItsParts) {
    const QFontMetrics metrics{QFont()};
    const QString hint = QStringLiteral("one part  ·  two  ·  three");
    EXPECT_EQ(wrapped_hint(hint, metrics, 10000), hint);
    const auto narrow = wrapped_hint(hint, metrics, metrics.horizontalAdvance("one part  ·  two") + 1);
    EXPECT_EQ(narrow, QStringLiteral("one part  ·  two\nthree"));
    EXPECT_EQ(wrapped_hint(hint, metrics, 1).count(u'\n'), 2);
}

TEST(LightHint, StandsOffTheLegend) {
    const auto look = [](QSize size, bool is_line) {
        ImageView view(nullptr, ImageView::Surface::raster);
        view.set_picture(make_picture(Image(48, 48, 1), Semantic::depth, {}, "m"));
        view.set_legend(true);
        view.camera().set_pose(camera_in_front());
        view.resize(size);
        view.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
        const qreal ratio = view.devicePixelRatioF();
        ASSERT_EQ(legend_place(view.state(), ratio).is_line, is_line);
        const auto bare = view.grab().toImage();
        auto behind = spot();
        behind.position = camera_in_front().eye;
        view.set_light(behind);
        ASSERT_FALSE(view.state().hint.isEmpty());
        const auto hinted = view.grab().toImage();
        EXPECT_NE(hinted, bare) << "there is a hint";
        const auto& t = view.transform();
        const QPointF end = t.offset() + t.zoom() * QPointF(t.image_size().width(), t.image_size().height());
        const int right = int(std::ceil(end.x() + 8 * ratio)), below = int(std::ceil(end.y()));
        const QRect legend = is_line ? QRect(0, below, bare.width(), int(legend_line_height(ratio)))
                                     : QRect(right, 0, bare.width() - right, bare.height());
        ASSERT_TRUE(bare.rect().contains(legend));
        EXPECT_EQ(hinted.copy(legend), bare.copy(legend)) << "it is not under the legend";
    };
    look({320, 170}, false);
    look({200, 420}, true);  // below the line is room for the hint
    look({200, 230}, true);  // it stands above
}

TEST_F(LightToolTest, ASunStandsWhereTheCameraLooksAndOnlyTurns) {
    auto sun = spot();
    sun.shape = PlacedLight::Shape::sun;
    view.set_light(sun);
    EXPECT_EQ(light().position, camera_in_front().target);
    EXPECT_EQ(handles_of(light()), std::vector{direction});
    QTest::keyClick(&view, Qt::Key_Right);
    EXPECT_EQ(light().position, camera_in_front().target);
    QTest::keyClick(&view, Qt::Key_Right, Qt::AltModifier);
    EXPECT_NE(light().direction, sun.direction);
}

TEST_F(LightToolTest, ExportedPicturesHaveNoHandles) {
    const auto with = view.snapshot(true, true);
    view.set_light({});
    EXPECT_EQ(view.snapshot(true, true), with);
    EXPECT_TRUE(view.accessibleDescription().isEmpty());
}

}  // namespace
}  // namespace ir::widgets
