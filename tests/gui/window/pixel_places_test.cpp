#include <gtest/gtest.h>

#include <random>

#include "app/engine/camera_pose.h"
#include "app/gui/pixel_places.h"
#include "renderers/scene/view.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

TEST(PixelPlaces, ALevelsPixelStandsForTheMainPixelAtItsCentre) {
    EXPECT_EQ(pixel_of_main({64, 48}, {32, 24}, {10, 6}), QPoint(21, 13));
    EXPECT_EQ(pixel_of_main({64, 48}, {64, 48}, {10, 6}), QPoint(10, 6));
    EXPECT_EQ(pixel_of_main({65, 49}, {32, 24}, {31, 23}), QPoint(63, 47));
    EXPECT_EQ(pixel_of_main({64, 48}, {1, 1}, {0, 0}), QPoint(32, 24));
    EXPECT_EQ(pixel_of_main({64, 48}, {30, 30}, {10, 6}), QPoint(-1, -1));
    EXPECT_EQ(pixel_of_main({64, 48}, {32, 24}, {-1, -1}), QPoint(-1, -1));
}

TEST(PixelPlaces, ThereAndBackIsTheSamePixel) {
    for (const QSize main : {QSize(64, 48), QSize(65, 49), QSize(31, 7)})
        for (int level = 0; level < 4; ++level) {
            const QSize size(std::max(1, main.width() >> level), std::max(1, main.height() >> level));
            for (int y = 0; y < size.height(); ++y)
                for (int x = 0; x < size.width(); ++x)
                    ASSERT_EQ(pixel_of_level(main, size, pixel_of_main(main, size, {x, y})), QPoint(x, y))
                        << main.width() << " level " << level;
        }
}

TEST(Sight, IsThatOfTheRenderers) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-3, 3);
    for (int i = 0; i < 60; ++i) {
        CameraPose pose;
        pose.eye = {number(random), number(random), number(random)};
        pose.target = {number(random), number(random), number(random)};
        if (i % 3 == 0) pose.target = pose.eye + glm::dvec3(0, i % 2 == 0 ? 2 : -2, 0);  // along up
        pose.orthographic = i % 4 == 0;
        pose.fov_y_degrees = 20 + i;
        const auto view = scene::make_view(engine::camera_of(pose), 300, 200, {{-9, -9, -9}, {9, 9, 9}});
        const glm::dvec2 place(0.5 + number(random) / 6, 0.5 + number(random) / 6);
        const auto theirs = scene::pixel_ray(view, glm::vec2(place) * glm::vec2(300, 200));
        const auto ours = widgets::sight_through(pose, 1.5, place);
        EXPECT_NEAR(glm::dot(ours.direction, glm::normalize(glm::dvec3(theirs.direction_ws))), 1, 1e-5);
        const auto point = ours.origin + 2.5 * ours.direction;
        const auto between = point - glm::dvec3(theirs.origin_ws);
        EXPECT_NEAR(glm::length(glm::cross(between, ours.direction)), 0, 1e-3) << "the same line";
        const auto back = widgets::place_of(pose, 1.5, point);
        ASSERT_TRUE(back);
        EXPECT_NEAR(glm::length(*back - place), 0, 1e-9);
        EXPECT_FALSE(widgets::place_of(pose, 1.5, ours.origin - 2.0 * ours.direction)) << "behind the eye";
    }
}

class PixelPlacesWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        const auto id = window.session().experiment()->id;
        window.session().edit([&](const auto& project) {
            return projects::edits::set_size(project, id, {64, 48});
        });
        ASSERT_TRUE(settle());
    }
    void click(QPoint pixel, Qt::KeyboardModifiers keys) {
        auto& view = window.view();
        window.workspace().active_pane().compare().active_view().look_at(QPointF(pixel), 8);
        const QPointF device = view.transform().view_from_pixel(pixel);
        const QPoint place = (device / view.devicePixelRatioF()).toPoint();
        QTest::mouseMove(&view, place + QPoint(1, 1));
        QTest::mouseMove(&view, place);
        QTest::mouseClick(&view, Qt::LeftButton, keys, place);
        ASSERT_TRUE(settle());
    }
};

TEST_F(PixelPlacesWindowTest, APixelOfALevelIsExplainedAsThatOfTheResultAndMarkedWhereItIs) {
    window.views().show_output("levels", 1);
    ASSERT_TRUE(settle());
    click({10, 6}, Qt::ShiftModifier);
    EXPECT_EQ(window.inspector().explained(), QPoint(21, 13));
    EXPECT_EQ(window.view().state().marks.picked, QPoint(10, 6));
}

TEST_F(PixelPlacesWindowTest, AMarkSetByHandStaysWhilePicturesArrive) {
    click({20, 10}, Qt::ShiftModifier);
    EXPECT_EQ(window.view().state().marks.picked, QPoint(20, 10));
    click({12, 7}, {});
    type_level("0.5");
    EXPECT_EQ(window.view().state().marks.picked, QPoint(12, 7));
    EXPECT_EQ(window.inspector().explained(), QPoint(20, 10));
    window.inspector().explain({3, 4});
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.view().state().marks.picked, QPoint(3, 4));
}

}  // namespace
}  // namespace ir::gui
