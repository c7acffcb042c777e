#include <QSignalSpy>
#include <cmath>

#include "tests/gui/widgets/compare/pictures.h"
#include "widgets/compare/view_link.h"

namespace ir::widgets {
namespace {

using Mode = CompareView::Mode;

void expect_same_region(const ImageView& a, const ImageView& b) {
    EXPECT_DOUBLE_EQ(a.transform().zoom(), b.transform().zoom());
    EXPECT_NEAR(a.transform().centre().x(), b.transform().centre().x(), 1 / a.transform().zoom());
    EXPECT_NEAR(a.transform().centre().y(), b.transform().centre().y(), 1 / a.transform().zoom());
}

TEST(Linking, ZoomAndPanGoTogetherUntilUnlinked) {
    CompareView view;
    fill(view, {flat(0.1f), flat(0.9f)});
    view.set_mode(Mode::side_by_side);
    show(view);
    ImageView &a = *view.views()[0], &b = *view.views()[1];
    const double fitted = a.transform().zoom();
    turn_wheel(&b, {100, 80}, 3);
    EXPECT_GT(a.transform().zoom(), fitted);
    expect_same_region(a, b);
    QTest::mousePress(&a, Qt::RightButton, {}, {150, 150});
    QTest::mouseMove(&a, {120, 130});
    QTest::mouseRelease(&a, Qt::RightButton, {}, {120, 130});
    expect_same_region(a, b);
    QSignalSpy linked(&view, &CompareView::linked_changed);
    QTest::keyClick(&a, Qt::Key_L);
    EXPECT_EQ(linked.count(), 1);
    EXPECT_FALSE(view.compared().linked);
    const double before = a.transform().zoom();
    turn_wheel(&b, {100, 80}, 2);
    EXPECT_DOUBLE_EQ(a.transform().zoom(), before);
    EXPECT_NE(b.transform().zoom(), before);
    QTest::keyClick(&b, Qt::Key_L);
    expect_same_region(a, b);
}

TEST(Linking, OtherSizesKeepOut) {
    ImageView a, b, c;
    for (auto* view : {&a, &b}) view->set_picture(flat(0.5f, {}, 32, 32));
    c.set_picture(flat(0.5f, {}, 16, 16));
    ViewLink link;
    for (auto* view : {&a, &b, &c}) {
        view->resize(200, 200);
        link.add(view);
    }
    const double before = c.transform().zoom();
    a.look_at({4, 4}, 7);
    expect_same_region(a, b);
    EXPECT_DOUBLE_EQ(c.transform().zoom(), before);
}

TEST(Linking, TheCursorIsMarkedInTheOtherViews) {
    CompareView view;
    fill(view, {flat(0.1f), flat(0.1f)});
    view.panes().set_pixel_grid(false);
    view.set_mode(Mode::side_by_side);
    show(view);
    ImageView &a = *view.views()[0], &b = *view.views()[1];
    const QImage plain = b.grab().toImage();
    emit a.cursor_moved({8, 6});
    EXPECT_NE(b.grab().toImage(), plain);
    emit a.cursor_moved({-1, -1});
    EXPECT_EQ(b.grab().toImage(), plain);
}

TEST(Linking, PickingMarksAllViews) {
    CompareView view;
    fill(view, {flat(0.1f), flat(0.9f)});
    view.set_mode(Mode::side_by_side);
    show(view);
    QSignalSpy picks(&view, &CompareView::picked_changed);
    QTest::mouseClick(view.views()[1], Qt::LeftButton, {}, point(*view.views()[1], 3.5, 4.5));
    ASSERT_EQ(picks.count(), 1);
    EXPECT_EQ(view.views()[0]->state().marks.picked, QPoint(3, 4));
}

TEST(Linking, TheCameraMovesInAllViewsUntilUnlinked) {
    CompareView view;
    fill(view, {flat(0.1f), flat(0.9f)});
    view.set_camera(CameraPose());
    view.set_mode(Mode::side_by_side);
    view.panes().set_tool(ImageView::Tool::orbit);
    show(view);
    ImageView &a = *view.views()[0], &b = *view.views()[1];
    QSignalSpy moves(&view, &CompareView::camera_moved), ends(&view, &CompareView::camera_gesture_finished);
    const auto drag = [](ImageView& each) {
        QTest::mousePress(&each, Qt::LeftButton, {}, {100, 100});
        QTest::mouseMove(&each, {140, 110});
        QTest::mouseRelease(&each, Qt::LeftButton, {}, {140, 110});
    };
    drag(b);
    ASSERT_GE(moves.count(), 1);
    EXPECT_EQ(moves.last()[1].toInt(), 1);
    EXPECT_EQ(ends.count(), 1);
    EXPECT_EQ(a.camera().pose(), b.camera().pose());
    EXPECT_NE(a.camera().pose(), CameraPose());
    view.set_linked(false);
    const CameraPose before = a.camera().pose();
    drag(b);
    EXPECT_EQ(a.camera().pose(), before);
    EXPECT_NE(b.camera().pose(), before);
}

TEST(Linking, LikePicturesShareTheColourRange) {
    CompareView view;
    Display wide = grey_display(), narrow = grey_display();
    wide.high = 10;
    view.set_pictures({flat(0.5f), flat(0.5f), make_picture(Image(16, 12, 3), Semantic::normal)});
    view.set_displays({wide, narrow, narrow});
    EXPECT_EQ(view.compared().shown_display(1), wide);
    EXPECT_EQ(view.compared().shown_display(2), narrow);  // another kind of numbers
    view.set_linked(false);
    EXPECT_EQ(view.compared().shown_display(1), narrow);
    view.set_mode(Mode::side_by_side);
    EXPECT_EQ(view.views()[1]->display(), narrow);
}

TEST(Linking, TheModeDoesNotLoseThePlace) {
    CompareView view;
    fill(view, {flat(0.1f, {}, 64, 64), flat(0.9f, {}, 64, 64), flat(0.3f, {}, 64, 64)});
    show(view, {800, 500});
    view.active_view().look_at({20, 40}, 24);
    for (Mode mode : {Mode::side_by_side, Mode::wipe, Mode::stages, Mode::difference, Mode::flip}) {
        view.set_mode(mode);
        for (auto* each : view.views()) {
            EXPECT_DOUBLE_EQ(each->transform().zoom(), 24) << int(mode);
            EXPECT_NEAR(each->transform().centre().x(), 20, 0.2) << int(mode);
            EXPECT_NEAR(each->transform().centre().y(), 40, 0.2) << int(mode);
        }
    }
}

}  // namespace
}  // namespace ir::widgets
