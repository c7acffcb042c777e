#include <QSignalSpy>

#include "tests/gui/widgets/metrics/pictures.h"
#include "widgets/compare/compare_view.h"

namespace ir::widgets {
namespace {

using Tool = ImageView::Tool;

QPoint middle_of(const ImageView& view, QPoint pixel) {
    return (view.transform().view_from_pixel(pixel) / view.devicePixelRatioF()).toPoint();
}

void draw_from(ImageView& view, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
    drag_mouse(view, middle_of(view, from), middle_of(view, to), modifiers);
}

class LineTest : public testing::TestWithParam<double> {
  protected:
    void SetUp() override {
        view.set_picture(make_picture(ramp(64, 48), Semantic::radiance));
        show(view, {600, 440});
        view.look_at({32, 24}, GetParam());
        view.set_tool(Tool::line);
    }
    const QLine& line() const { return view.state().marks.line; }
    ImageView view{nullptr, ImageView::Surface::raster};
};

INSTANTIATE_TEST_SUITE_P(Zoom, LineTest, testing::Values(2.0, 8.0));

/// It is in the bottom left corner, where in these views there is nothing of the picture.
TEST_P(LineTest, AHintStandsThereUntilALineIsDrawn) {
    const QRect corner(8, view.height() - 40, 60, 32);
    const auto hinted = view.grab(corner).toImage();
    draw_from(view, {28, 20}, {36, 24});
    const auto drawn = view.grab(corner).toImage();
    EXPECT_NE(hinted, drawn);
    QTest::keyClick(&view, Qt::Key_Escape);
    EXPECT_EQ(view.grab(corner).toImage(), hinted);
    view.set_tool(Tool::inspect);
    EXPECT_EQ(view.grab(corner).toImage(), drawn) << "what is there without a hint";
}

TEST(ToolHints, StandInOnePictureThatHasRoom) {
    PaneBoard board(nullptr, ImageView::Surface::raster);
    for (int i = 0; i < 3; ++i) board.pane(i).set_picture(make_picture(ramp(64, 48), Semantic::radiance));
    std::vector<PaneBoard::Cell> cells(3);
    for (int i = 0; i < 3; ++i) cells[std::size_t(i)].place = {double(i), 0};
    board.arrange(cells, {3, 1}, false);
    board.set_tool(Tool::line);
    const auto hinted = [&] {
        std::vector<int> panes;
        for (int i = 0; i < 3; ++i)
            if (!board.pane(i).state().hint.isEmpty()) panes.push_back(i);
        return panes;
    };
    show(board, {1200, 300});
    EXPECT_EQ(hinted(), std::vector{0});
    emit board.pane(2).cursor_moved({1, 1});
    EXPECT_EQ(hinted(), std::vector{2}) << "under the cursor";
    board.set_hinted(false);
    EXPECT_EQ(hinted(), std::vector<int>{}) << "it is known";
    board.set_hinted(true);
    board.resize(560, 300);
    EXPECT_TRUE(QTest::qWaitFor([&] { return hinted().empty(); })) << "it would cover them";
}

TEST_P(LineTest, IsDrawnMovedAndTurnedByMouse) {
    QSignalSpy changed(&view, &ImageView::line_changed), picked(&view, &ImageView::picked_changed);
    QSignalSpy drawn(&view, &ImageView::shape_drawn), region(&view, &ImageView::region_changed);
    draw_from(view, {10, 8}, {41, 31});
    EXPECT_EQ(line(), QLine(10, 8, 41, 31));
    EXPECT_GE(changed.count(), 1);
    EXPECT_EQ(drawn.count(), 1);
    draw_from(view, {41, 31}, {50, 20});  // its end
    EXPECT_EQ(line(), QLine(10, 8, 50, 20));
    draw_from(view, {10, 8}, {10, 20});  // its start
    EXPECT_EQ(line(), QLine(10, 20, 50, 20));
    draw_from(view, {30, 20}, {33, 26});  // all of it
    EXPECT_EQ(line(), QLine(13, 26, 53, 26));
    draw_from(view, {33, 26}, {60, 28}, Qt::ShiftModifier);  // along one axis, and not out of the picture
    EXPECT_EQ(line(), QLine(23, 26, 63, 26));
    draw_from(view, {3, 3}, {20, 5}, Qt::ShiftModifier);  // elsewhere: a new one, straight
    EXPECT_EQ(line(), QLine(3, 3, 20, 3));
    draw_from(view, {3, 40}, {20, 20}, Qt::ShiftModifier);
    EXPECT_EQ(line(), QLine(3, 40, 23, 20)) << "diagonal";
    EXPECT_EQ(picked.count() + region.count(), 0);
    drawn.clear();
    QTest::mouseClick(&view, Qt::LeftButton, {}, middle_of(view, {50, 40}));
    QTest::mouseClick(&view, Qt::LeftButton, {}, middle_of(view, {13, 30}));  // on the line
    EXPECT_EQ(line(), QLine(3, 40, 23, 20)) << "a click draws nothing";
    EXPECT_EQ(drawn.count(), 0);
}

TEST_P(LineTest, IsDrawnNudgedAndClearedByKeys) {
    QSignalSpy drawn(&view, &ImageView::shape_drawn);
    view.setFocus();
    QTest::keyClick(&view, Qt::Key_Escape);
    QTest::keyClick(&view, Qt::Key_Right);
    EXPECT_EQ(line(), QLine(0, 24, 63, 24)) << "the middle row";
    QTest::keyClick(&view, Qt::Key_Down);
    QTest::keyClick(&view, Qt::Key_Right);  // it is as wide as the picture
    EXPECT_EQ(line(), QLine(0, 25, 63, 25));
    EXPECT_EQ(drawn.count(), 2) << "what moves nothing is not told";
    QTest::keyClick(&view, Qt::Key_Up, Qt::ShiftModifier);
    QTest::keyClick(&view, Qt::Key_Left, Qt::ShiftModifier);
    EXPECT_EQ(line(), QLine(0, 25, 62, 24));
    QTest::keyClick(&view, Qt::Key_Delete);
    EXPECT_TRUE(line().isNull());
    QTest::keyClick(&view, Qt::Key_Up);
    EXPECT_EQ(line(), QLine(32, 0, 32, 47)) << "the middle column";
    QTest::mousePress(&view, Qt::LeftButton, {}, middle_of(view, {10, 10}));
    QTest::mouseMove(&view, middle_of(view, {40, 30}));
    EXPECT_NE(line(), QLine(32, 0, 32, 47));
    QTest::keyClick(&view, Qt::Key_Escape);  // takes the drag back
    EXPECT_EQ(line(), QLine(32, 0, 32, 47));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, middle_of(view, {40, 30}));
    EXPECT_EQ(line(), QLine(32, 0, 32, 47));
    view.set_tool(Tool::inspect);
    QTest::keyClick(&view, Qt::Key_Escape);
    EXPECT_FALSE(line().isNull()) << "another tool's keys";
}

TEST_P(LineTest, IsPartOfWhatIsSeenButNotOfThePicture) {
    const auto plain = view.snapshot(true, false);
    view.set_mark(&Marks::line, {10, 8, 41, 31});
    const auto with = view.snapshot(true, false);
    EXPECT_NE(with, plain);
    const auto bare = view.snapshot(false, false);
    view.set_mark(&Marks::line, {});
    EXPECT_EQ(bare, view.snapshot(false, false));
}

TEST(LineOfPanes, IsInAllPicturesOfItsSizeAlone) {
    CompareView compare(nullptr, ImageView::Surface::raster);
    compare.set_pictures({radiance(ramp(64, 48)), radiance(ramp(64, 48))});
    compare.set_mode(CompareView::Mode::side_by_side);
    show(compare, {900, 440});
    QSignalSpy changed(&compare.panes(), &PaneBoard::line_changed);
    compare.panes().set_tool(Tool::line);
    draw_from(compare.panes().pane(0), {10, 8}, {40, 30});
    ASSERT_GE(changed.count(), 1);
    EXPECT_EQ(changed.back()[0].toSize(), QSize(64, 48));
    EXPECT_EQ(compare.panes().pane(1).state().marks.line, QLine(10, 8, 40, 30));
    compare.set_pictures({radiance(ramp(32, 24)), radiance(ramp(32, 24))});
    EXPECT_TRUE(compare.panes().pane(1).state().marks.line.isNull());
    compare.set_pictures({radiance(ramp(64, 48)), radiance(ramp(64, 48))});
    EXPECT_EQ(compare.panes().pane(1).state().marks.line, QLine(10, 8, 40, 30));
}

}  // namespace
}  // namespace ir::widgets
