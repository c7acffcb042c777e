#include <QAction>
#include <QDockWidget>
#include <QMainWindow>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>

#include "tests/gui/events.h"
#include "tests/gui/widgets/compare/pictures.h"

namespace ir::widgets {
namespace {

using Mode = CompareView::Mode;

INSTANTIATE_TEST_SUITE_P(Surfaces, CompareTest, testing::Values(true, false), surface_name);

std::vector<PicturePtr> two() {
    return {make_picture(quarters(1), Semantic::depth, "ours"),
            make_picture(quarters(0.5f), Semantic::depth, "reference")};
}

/// The four quarters of a view's picture, each where it belongs.
void expect_quarters(ImageView& view, double scale) {
    EXPECT_NEAR(grey_at(view, 2.5, 2.5), grey_of(0.1 * scale), 2);
    EXPECT_NEAR(grey_at(view, 13.5, 2.5), grey_of(0.3 * scale), 2);
    EXPECT_NEAR(grey_at(view, 2.5, 9.5), grey_of(0.6 * scale), 2);
    EXPECT_NEAR(grey_at(view, 13.5, 9.5), grey_of(1.0 * scale), 2);
}

TEST_P(CompareTest, NoModeTurnsAPicture) {
    CompareView view(nullptr, surface());
    fill(view, two());
    view.panes().set_pixel_grid(false);
    view.set_difference_display(grey_display());
    view.set_difference(DifferenceKind::absolute);
    show(view);
    expect_quarters(view.main_view(), 1);
    view.set_mode(Mode::flip);
    view.flip_next();
    expect_quarters(view.main_view(), 0.5);
    view.set_mode(Mode::side_by_side);
    ASSERT_EQ(view.views().size(), 2u);
    expect_quarters(*view.views()[0], 1);
    expect_quarters(*view.views()[1], 0.5);
    view.set_mode(Mode::difference);
    wait_for_differences(view);
    view.active_view().look_at({8, 6}, 20);
    expect_quarters(view.main_view(), 0.5);
    view.set_mode(Mode::stages);
    wait_for_differences(view);
    ASSERT_EQ(view.difference_views().size(), 1u);
    view.active_view().fit();
    expect_quarters(*view.views()[1], 0.5);
    expect_quarters(*view.difference_views()[0], 0.5);
    view.set_mode(Mode::wipe);
    view.set_wipe(0);
    expect_quarters(view.main_view(), 0.5);
    view.set_wipe(1);
    expect_quarters(view.main_view(), 1);
}

TEST_P(CompareTest, SnapshotsAreNotTurnedEither) {
    CompareView view(nullptr, surface());
    fill(view, two());
    show(view);
    const QImage shot = view.panes().snapshot(false, false, ImageView::SnapshotScale::picture_pixels);
    ASSERT_EQ(shot.size(), QSize(16, 12));
    EXPECT_EQ(shot.pixelColor(1, 1).red(), grey_of(0.1));
    EXPECT_EQ(shot.pixelColor(14, 1).red(), grey_of(0.3));
    EXPECT_EQ(shot.pixelColor(1, 10).red(), grey_of(0.6));
    view.set_mode(Mode::wipe);
    const QImage wipe = view.panes().snapshot(false, false, ImageView::SnapshotScale::picture_pixels);
    EXPECT_EQ(wipe.pixelColor(14, 10).red(), grey_of(0.5));
    EXPECT_EQ(wipe.pixelColor(1, 10).red(), grey_of(0.6));
}

TEST_P(CompareTest, TheDividerIsDragged) {
    CompareView view(nullptr, surface());
    fill(view, two());
    view.panes().set_pixel_grid(false);
    view.set_mode(Mode::wipe);
    show(view);
    ImageView& main = view.main_view();
    EXPECT_NEAR(grey_at(main, 7, 10), grey_of(0.6), 2);
    EXPECT_NEAR(grey_at(main, 9, 10), grey_of(0.5), 2);
    const int uploads = main.canvas().upload_count();
    QSignalSpy moves(&view, &CompareView::wipe_moved), picks(&view, &CompareView::picked_changed);
    QTest::mousePress(&main, Qt::LeftButton, {}, point(main, 8, 3));
    QTest::mouseMove(&main, point(main, 6, 3));
    QTest::mouseMove(&main, point(main, 4, 3));
    QTest::mouseRelease(&main, Qt::LeftButton, {}, point(main, 4, 3));
    EXPECT_GE(moves.count(), 1);
    EXPECT_EQ(picks.count(), 0);
    EXPECT_NEAR(view.compared().wipe, 0.25, 0.01);
    EXPECT_NEAR(grey_at(main, 5, 10), grey_of(0.3), 2);
    EXPECT_NEAR(grey_at(main, 3, 10), grey_of(0.6), 2);
    turn_wheel(&main, {200, 100}, 1);
    main.grab();
    EXPECT_EQ(main.canvas().upload_count(), uploads);  // neither dragging nor zooming costs an upload
    const double before = view.compared().wipe;
    QTest::keyClick(&main, Qt::Key_Right);
    EXPECT_NEAR(view.compared().wipe, before + 0.01, 1e-9);
}

TEST_P(CompareTest, TheCursorTellsTheSideOfTheDivider) {
    CompareView view(nullptr, surface());
    fill(view, two());
    view.set_mode(Mode::wipe);
    show(view);
    QSignalSpy cursor(&view, &CompareView::cursor_moved);
    for (const auto& [x, picture] : {std::pair(2.5, 0), std::pair(12.5, 1)}) {
        QTest::mouseMove(&view.main_view(), point(view.main_view(), x, 5.5));
        ASSERT_TRUE(QTest::qWaitFor(
            [&, x = x] { return !cursor.isEmpty() && cursor.last()[0].toPoint() == QPoint(int(x), 5); }));
        EXPECT_EQ(cursor.last()[1].toInt(), picture);
    }
}

TEST_P(CompareTest, TheLensShowsTheOtherPictureAboutTheCursor) {
    CompareView view(nullptr, surface());
    fill(view, two());
    view.panes().set_pixel_grid(false);
    view.set_mode(Mode::lens);
    show(view);
    ImageView& main = view.main_view();
    QSignalSpy cursor(&view, &CompareView::cursor_moved);
    const auto move_to = [&](QPoint pixel) {
        QTest::mouseMove(&main, point(main, pixel.x() + 0.5, pixel.y() + 0.5));
        return QTest::qWaitFor([&] { return !cursor.isEmpty() && cursor.last()[0].toPoint() == pixel; });
    };
    ASSERT_TRUE(move_to({13, 2}));
    EXPECT_NEAR(grey_at(main, 13, 2), grey_of(0.15), 2) << "B's upper right";
    EXPECT_NEAR(grey_at(main, 13, 10), grey_of(1), 2) << "A below it";
    ASSERT_TRUE(move_to({3, 9}));
    EXPECT_EQ(cursor.last()[1].toInt(), 1) << "values are those of B";
    EXPECT_NEAR(grey_at(main, 3, 10), grey_of(0.3), 2) << "B's lower left";
    EXPECT_NEAR(grey_at(main, 13, 2), grey_of(0.3), 2) << "A elsewhere";
    EXPECT_NEAR(grey_at(main, 13, 10), grey_of(1), 2);
    EXPECT_NEAR(grey_at(main, 3, 2), grey_of(0.1), 2);
    const QRect lens = main.state().second_area();
    EXPECT_NEAR(lens.center().x(), main.transform().view_from_image({3.5, 9.5}).x(), 2);
    QTest::keyClick(&main, Qt::Key_Right, Qt::ShiftModifier);
    EXPECT_GT(main.state().second_area().center().x(), lens.center().x()) << "arrow keys move it";
    EXPECT_EQ(main.state().second_area().center().y(), lens.center().y());
    EXPECT_GT(cursor.last()[0].toPoint().x(), 3) << "what is read is the pixel in its middle";
    view.set_mode(Mode::wipe);
    EXPECT_NEAR(grey_at(main, 3, 10), grey_of(0.6), 2) << "left of the divider";
}

TEST_P(CompareTest, AHeldNumberShowsItsPicture) {
    CompareView view(nullptr, surface());
    auto pictures = two();
    pictures.push_back(flat(0.8f, "third"));
    fill(view, pictures);
    view.panes().set_pixel_grid(false);
    show(view);
    ImageView& main = view.main_view();
    for (Mode mode : {Mode::single, Mode::wipe, Mode::flip, Mode::difference}) {
        view.set_mode(mode);
        wait_for_differences(view);
        const QString before = main.state().label;
        QTest::keyPress(&main, Qt::Key_2);
        expect_quarters(main, 0.5);
        EXPECT_TRUE(main.state().label.startsWith("B"));
        QTest::keyRelease(&main, Qt::Key_2);
        QTest::keyPress(&main, Qt::Key_3);
        EXPECT_NEAR(grey_at(main, 2.5, 2.5), grey_of(0.8), 2);
        QTest::keyRelease(&main, Qt::Key_3);
        EXPECT_EQ(main.state().label, before) << int(mode);
        QTest::keyClick(&main, Qt::Key_4);  // there is none
        EXPECT_EQ(main.state().label, before);
    }
}

TEST_P(CompareTest, FlippingUploadsNothingAgain) {
    CompareView view(nullptr, surface());
    fill(view, two());
    view.set_mode(Mode::flip);
    show(view);
    ImageView& main = view.main_view();
    main.grab();
    QTest::keyClick(&main, Qt::Key_Tab);
    main.grab();
    const int uploads = main.canvas().upload_count();
    for (int i = 0; i < 4; ++i) {
        QTest::keyClick(&main, Qt::Key_Tab);
        EXPECT_NEAR(grey_at(main, 2.5, 9.5), grey_of(i % 2 ? 0.3 : 0.6), 2);
    }
    EXPECT_EQ(main.canvas().upload_count(), uploads);
    EXPECT_EQ(view.active_picture(), 1);
}

TEST_P(CompareTest, StagesHaveTheirDifferencesBeneath) {
    CompareView view(nullptr, surface());
    fill(view, {flat(0.2f, "first"), flat(0.5f, "second"), flat(0.4f, "third"), flat(0.4f, "fourth")});
    view.set_difference_display(grey_display());
    view.set_difference(DifferenceKind::absolute);
    view.panes().set_pixel_grid(false);
    view.set_mode(Mode::stages);
    show(view, {1200, 400});
    wait_for_differences(view);
    ASSERT_EQ(view.views().size(), 4u);
    ASSERT_EQ(view.difference_views().size(), 3u);
    view.active_view().fit();
    const double expected[] = {0.3, 0.1, 0};
    for (int i = 0; i < 3; ++i) {
        ImageView& below = *view.difference_views()[i];
        EXPECT_NEAR(grey_at(below, 8, 11.5), grey_of(expected[i]), 2);
        EXPECT_GT(below.y(), view.views()[i]->geometry().bottom());
        EXPECT_GT(below.geometry().center().x(), view.views()[i]->geometry().center().x());
        EXPECT_LT(below.geometry().center().x(), view.views()[i + 1]->geometry().center().x());
    }
    turn_wheel(view.difference_views()[1], {60, 60}, 3);
    for (auto* each : view.views())
        EXPECT_DOUBLE_EQ(each->transform().zoom(), view.difference_views()[1]->transform().zoom());
    view.resize(500, 400);
    auto* bar = view.findChild<QScrollArea*>()->horizontalScrollBar();
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar->maximum() > 0; }));
}

TEST_P(CompareTest, TwoStandBelowEachOtherInAHighView) {
    CompareView view(nullptr, surface());
    fill(view, two());
    view.set_mode(Mode::side_by_side);
    show(view, {640, 300});
    ASSERT_EQ(view.views().size(), 2u);
    EXPECT_GT(view.views()[1]->x(), view.views()[0]->geometry().right());
    view.resize(300, 640);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view.views()[1]->y() > view.views()[0]->geometry().bottom(); }));
    EXPECT_EQ(view.views()[1]->x(), view.views()[0]->x());
    view.resize(640, 560);  // one below the other would be larger
    EXPECT_TRUE(QTest::qWaitFor([&] { return view.views()[1]->x() > view.views()[0]->geometry().right(); }));
}

TEST_P(CompareTest, FloatingAndDockingKeepsThePicture) {
    QMainWindow window;
    window.setCentralWidget(new QWidget);
    auto* dock = new QDockWidget(&window);
    auto* view = new CompareView(dock, surface());
    fill(*view, two());
    view->panes().set_pixel_grid(false);
    view->set_mode(Mode::side_by_side);
    dock->setWidget(view);
    window.addDockWidget(Qt::RightDockWidgetArea, dock);
    show(window, {900, 600});
    for (bool floating : {false, true, false, true, false}) {
        dock->setFloating(floating);
        ASSERT_TRUE(QTest::qWaitForWindowExposed(floating ? static_cast<QWidget*>(dock) : &window));
        ir::test::handle_events();
        view->active_view().fit();
        ASSERT_EQ(dock->isFloating(), floating);
        expect_quarters(*view->views()[0], 1);
        expect_quarters(*view->views()[1], 0.5);
    }
}

TEST_P(CompareTest, RefusesUnequalSizesAndNamesThem) {
    CompareView view(nullptr, surface());
    fill(view, {flat(0.2f, "large", 16, 12), flat(0.2f, "small", 8, 6)});
    show(view);
    for (Mode mode : {Mode::side_by_side, Mode::wipe, Mode::flip, Mode::difference, Mode::stages}) {
        view.set_mode(mode);
        EXPECT_TRUE(view.compared().refusal().contains("16×12")) << int(mode);
        EXPECT_TRUE(view.compared().refusal().contains("8×6")) << int(mode);
        EXPECT_EQ(view.views().back()->state().note, view.compared().refusal()) << int(mode);
        EXPECT_FALSE(view.is_computing());
    }
    view.set_mode(Mode::side_by_side);
    EXPECT_FALSE(view.views()[0]->image().empty());
    QTest::keyClick(view.views()[0], Qt::Key_L);  // on their own, both can be looked at
    EXPECT_TRUE(view.compared().refusal().isEmpty());
    EXPECT_EQ(view.views()[1]->image().width, 8);
    view.set_mode(Mode::single);
    EXPECT_TRUE(view.compared().refusal().isEmpty());
}

TEST_P(CompareTest, SaysWhyAPictureIsMissing) {
    CompareView view(nullptr, surface());
    fill(view, {flat(0.2f, "ours"), make_note("The reference failed: no light.", "reference")});
    show(view);
    for (Mode mode : {Mode::wipe, Mode::difference}) {
        view.set_mode(mode);
        EXPECT_TRUE(view.main_view().state().note.contains("no light")) << int(mode);
    }
    view.set_mode(Mode::side_by_side);
    EXPECT_TRUE(view.views()[1]->state().note.contains("no light"));
    EXPECT_FALSE(view.views()[0]->image().empty());
}

TEST(CompareKeys, AHeldNumberIsNoShortcut) {
    QMainWindow window;
    auto* view = new CompareView(nullptr, ImageView::Surface::raster);
    window.setCentralWidget(view);
    QAction actual("1:1", &window);
    actual.setShortcut(QKeySequence(Qt::Key_1));
    window.addAction(&actual);
    QSignalSpy triggered(&actual, &QAction::triggered);
    fill(*view, two());
    view->set_mode(Mode::wipe);
    show(window, {640, 480});
    window.activateWindow();
    view->main_view().setFocus();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    QTest::keyPress(window.windowHandle(), Qt::Key_1);
    EXPECT_TRUE(view->main_view().state().label.startsWith("A"));
    EXPECT_FALSE(view->main_view().state().pictures[1].picture);
    QTest::keyRelease(window.windowHandle(), Qt::Key_1);
    EXPECT_EQ(triggered.count(), 0);
    view->set_mode(Mode::side_by_side);  // nothing to hold here
    QTest::keyClick(window.windowHandle(), Qt::Key_1);
    EXPECT_EQ(triggered.count(), 1);
}

}  // namespace
}  // namespace ir::widgets
