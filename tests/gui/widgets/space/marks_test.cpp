#include "widgets/space/space_marks.h"

#include <gtest/gtest.h>

#include <QImage>
#include <QPainter>

namespace ir::widgets {
namespace {

QImage painted(const SpaceMarks& marks, const CameraPose& camera) {
    QImage image(200, 100, QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    paint_marks(painter, marks, camera, image.rect());
    return image;
}

TEST(SpaceMarksTest, PinsStandWherePointsAreSeenAndNotBehindTheCamera) {
    CameraPose camera;  // at (0, 0, 5), towards the origin
    SpaceMarks marks;
    marks.pins = {{{0, 0, 0}, Qt::red, 1}};
    EXPECT_EQ(painted(marks, camera).pixelColor(100, 50), QColor(Qt::red));
    marks.pins[0].place = {0, 0, 9};
    EXPECT_EQ(painted(marks, camera), painted({}, camera));
    // Far beyond the edges a painter would lose its digits.
    marks = {};
    marks.lines = {{{{0, 0, 0}, {1e9, 0, 4.999999}}, Qt::green, 2}};
    EXPECT_EQ(painted(marks, camera), painted({}, camera));
}

TEST(SpaceMarksTest, AFrustumHasTheCornersOfThePicture) {
    CameraPose camera;
    camera.fov_y_degrees = 90;
    const auto lines = frustum(camera, 2, 1.5, Qt::white, 1);
    ASSERT_EQ(lines.size(), 6u);
    const auto& corners = lines[0].points;
    ASSERT_EQ(corners.size(), 5u);
    EXPECT_EQ(corners.front(), corners.back());
    EXPECT_NEAR(corners[0].x, -3, 1e-9);
    EXPECT_NEAR(corners[0].y, 1.5, 1e-9);
    EXPECT_NEAR(corners[2].x, 3, 1e-9);
    EXPECT_NEAR(corners[2].z, 3.5, 1e-9);
    for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(lines[i].points.front(), camera.eye);
}

}  // namespace
}  // namespace ir::widgets
