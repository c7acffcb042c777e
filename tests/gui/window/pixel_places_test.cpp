#include <gtest/gtest.h>

#include "app/gui/pixel_places.h"
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
        const QPointF device = view.transform().view_from_image(QPointF(pixel) + QPointF(0.5, 0.5));
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
