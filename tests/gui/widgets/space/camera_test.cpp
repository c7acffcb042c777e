#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "tests/gui/events.h"
#include "widgets/space/picture_pacer.h"
#include "widgets/space/space_camera.h"

namespace ir::widgets {
namespace {

TEST(PicturePacer, TheNextRequestWaitsForTheAnswer) {
    PicturePacer pacer(60'000);
    QSignalSpy due(&pacer, &PicturePacer::due), late(&pacer, &PicturePacer::late);
    for (int i = 0; i < 5; ++i) {
        pacer.want();
        ir::test::handle_events();
    }
    EXPECT_EQ(due.count(), 1);
    pacer.answered();
    ir::test::handle_events();
    EXPECT_EQ(due.count(), 2);
    EXPECT_EQ(late.count(), 0);
}

TEST(PicturePacer, AnOverdueAnswerIsNotWaitedFor) {
    PicturePacer pacer(20);
    QSignalSpy due(&pacer, &PicturePacer::due), late(&pacer, &PicturePacer::late);
    pacer.want();
    ASSERT_TRUE(QTest::qWaitFor([&] { return late.count() == 1; }));
    EXPECT_EQ(due.count(), 1);  // nothing new was wanted
    pacer.want();
    EXPECT_TRUE(QTest::qWaitFor([&] { return due.count() == 2; }));
}

TEST(PicturePacer, HeldRequestsFollowLater) {
    PicturePacer pacer;
    QSignalSpy due(&pacer, &PicturePacer::due);
    pacer.set_held(true);
    pacer.want();
    ir::test::handle_events();
    EXPECT_EQ(due.count(), 0);
    pacer.set_held(false);
    pacer.want();
    pacer.want();
    ir::test::handle_events();
    EXPECT_EQ(due.count(), 1);
    EXPECT_FALSE(pacer.is_idle());
    pacer.answered();
    ir::test::handle_events();
    EXPECT_EQ(due.count(), 1);
    EXPECT_TRUE(pacer.is_idle());
}

TEST(SpaceCamera, ADollyKeepsThePointUnderTheCursor) {
    CameraPose pose;
    const QPointF at(0.3, -0.2);
    const auto point = [&](const CameraPose& p) {
        const CameraAxes axes = camera_axes(p);
        return p.target + (axes.right * at.x() + axes.up * at.y()) * height_at_target(p);
    };
    const CameraPose nearer = dollied_towards(pose, at, 0.5);
    EXPECT_NEAR(glm::length(nearer.target - nearer.eye), 2.5, 1e-9);
    EXPECT_NEAR(glm::length(point(pose) - point(nearer)), 0, 1e-9);
}

TEST(SpaceCamera, AFramedBoxFitsWideAndTallPictures) {
    const SpaceBox box{{-3, 0, -1}, {5, 2, 1}};
    for (const double aspect : {0.4, 1.0, 2.5}) {
        CameraPose pose;
        pose.eye = {4, 3, 7};
        const CameraPose view = framed(pose, box, aspect);
        const CameraAxes axes = camera_axes(view);
        EXPECT_NEAR(glm::length(axes.forward - camera_axes(pose).forward), 0, 1e-9);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 at(corner & 1 ? box.low.x : box.high.x, corner & 2 ? box.low.y : box.high.y,
                                corner & 4 ? box.low.z : box.high.z);
            const glm::dvec3 d = at - view.eye;
            const double half = glm::dot(d, axes.forward) * std::tan(glm::radians(view.fov_y_degrees / 2));
            EXPECT_LE(std::abs(glm::dot(d, axes.up)), half);
            EXPECT_LE(std::abs(glm::dot(d, axes.right)), half * aspect);
        }
    }
}

TEST(SpaceCamera, RulersAreRound) {
    EXPECT_DOUBLE_EQ(round_length(7.3), 5);
    EXPECT_DOUBLE_EQ(round_length(0.049), 0.02);
    EXPECT_DOUBLE_EQ(round_length(1500), 1000);
    EXPECT_EQ(round_length(0), 0);
}

}  // namespace
}  // namespace ir::widgets
