#include <QSignalSpy>
#include <cmath>

#include "tests/gui/widgets/metrics/pictures.h"
#include "widgets/compare/compare_view.h"
#include "widgets/image/region.h"

namespace ir::widgets {
namespace {

using Mode = CompareView::Mode;
using Tool = ImageView::Tool;

/// Widget coordinates of a point of the picture; at 1:1 the middle of a pixel is the pixel.
QPoint point(const ImageView& view, double x, double y) {
    const QPointF at = view.transform().view_from_image({x, y}) / view.devicePixelRatioF();
    return {int(std::floor(at.x())), int(std::floor(at.y()))};
}

void drag(ImageView& view, QPointF from, QPointF to, Qt::KeyboardModifiers modifiers = {}) {
    drag_mouse(view, point(view, from.x(), from.y()), point(view, to.x(), to.y()), modifiers);
}

class RectangleTest : public testing::TestWithParam<double> {
  protected:
    void SetUp() override {
        view.set_picture(make_picture(ramp(64, 48), Semantic::radiance));
        show(view, {600, 440});
        view.look_at({32, 24}, GetParam());
        view.set_tool(Tool::rectangle);
    }
    ImageView view{nullptr, ImageView::Surface::raster};
};

INSTANTIATE_TEST_SUITE_P(Zoom, RectangleTest, testing::Values(1.0, 2.0, 8.0));

TEST_P(RectangleTest, IsDrawnMovedAndResizedByMouse) {
    const double zoom = GetParam();
    QSignalSpy changed(&view, &ImageView::region_changed), picked(&view, &ImageView::picked_changed);
    drag(view, {10.5, 8.5}, {41.5, 31.5});
    EXPECT_EQ(view.state().marks.region, QRect(10, 8, 32, 24));
    EXPECT_GE(changed.count(), 1);
    EXPECT_EQ(picked.count(), 0);
    drag(view, {26.5, 20.5}, {31.5, 17.5});  // inside: moves
    EXPECT_EQ(view.state().marks.region, QRect(15, 5, 32, 24));
    drag(view, {26.5, 17.5}, {30.5, 37.5}, Qt::ShiftModifier);  // along one axis, and not out of the picture
    EXPECT_EQ(view.state().marks.region, QRect(15, 24, 32, 24));
    drag(view, {47, 36}, {55, 36});  // the right edge
    EXPECT_EQ(view.state().marks.region, QRect(15, 24, 40, 24));
    drag(view, {15, 24}, {19, 30});  // the top left corner
    EXPECT_EQ(view.state().marks.region, QRect(19, 30, 36, 18));
    drag(view, {2.5, 2.5}, {9.5, 20.5}, Qt::ShiftModifier);  // elsewhere: a new one, square
    EXPECT_EQ(view.state().marks.region, QRect(2, 2, 19, 19));
    drag(view, {60.5, 40.5}, {60.5 + 1 / zoom, 40.5});  // a click that trembles
    EXPECT_EQ(view.state().marks.region, QRect(2, 2, 19, 19));
    drag(view, {50.5, 44.5}, {90, 80});  // beyond the picture
    EXPECT_EQ(view.state().marks.region, QRect(50, 44, 14, 4));
}

TEST_P(RectangleTest, IsNudgedAndClearedByKeys) {
    view.set_mark(&Marks::region, {10, 8, 20, 10});
    view.setFocus();
    QSignalSpy changed(&view, &ImageView::region_changed);
    QTest::keyClick(&view, Qt::Key_Right);
    QTest::keyClick(&view, Qt::Key_Down);
    QTest::keyClick(&view, Qt::Key_Down);
    EXPECT_EQ(view.state().marks.region, QRect(11, 10, 20, 10));
    QTest::keyClick(&view, Qt::Key_Left, Qt::ShiftModifier);
    QTest::keyClick(&view, Qt::Key_Down, Qt::ShiftModifier);
    EXPECT_EQ(view.state().marks.region, QRect(11, 10, 19, 11));
    EXPECT_EQ(changed.count(), 5);
    for (int i = 0; i < 30; ++i) QTest::keyClick(&view, Qt::Key_Left);
    EXPECT_EQ(view.state().marks.region.left(), 0);
    QTest::keyClick(&view, Qt::Key_Escape);
    EXPECT_TRUE(view.state().marks.region.isEmpty());
    view.set_mark(&Marks::region, {10, 8, 20, 10});
    view.set_tool(Tool::inspect);
    QTest::keyClick(&view, Qt::Key_Escape);  // no business of another tool
    EXPECT_EQ(view.state().marks.region, QRect(10, 8, 20, 10));
}

TEST_P(RectangleTest, IsPartOfOverlaysAlone) {
    view.set_pixel_grid(false);
    const auto plain = view.snapshot(false, false), before = view.snapshot(true, false);
    view.set_mark(&Marks::region, {10, 8, 20, 10});
    EXPECT_EQ(view.snapshot(false, false), plain);
    const auto shot = view.snapshot(true, false);
    EXPECT_NE(shot, before);
    QRect differs;
    for (int y = 0; y < shot.height(); ++y)
        for (int x = 0; x < shot.width(); ++x)
            if (shot.pixel(x, y) != before.pixel(x, y)) differs |= QRect(x, y, 1, 1);
    const QPointF from = view.transform().view_from_image({10, 8}),
                  to = view.transform().view_from_image({30, 18});
    EXPECT_LE(std::abs(differs.left() - from.x()), 3);
    EXPECT_LE(std::abs(differs.top() - from.y()), 3);
    EXPECT_LE(std::abs(differs.right() - to.x()), 3);
    EXPECT_LE(std::abs(differs.bottom() - to.y()), 3);  // neither handles nor the size are exported
}

TEST(RegionArithmetic, KeepsToThePicture) {
    const QSize picture(64, 48);
    EXPECT_EQ(drawn_region({-5, -5}, {3.2, 2.9}, false, picture), QRect(0, 0, 4, 3));
    EXPECT_TRUE(drawn_region({70, 3}, {90, 9}, false, picture).isEmpty());
    EXPECT_EQ(drawn_region({60, 40}, {90, 42}, true, picture).size(), QSize(4, 4));
    EXPECT_EQ(dragged_region({4, 4, 8, 8}, {-1, 0, false}, {100, 0}, false, picture), QRect(11, 4, 1, 8));
    EXPECT_EQ(dragged_region({4, 4, 8, 4}, {1, 1, false}, {8, 0}, true, picture), QRect(4, 4, 16, 8));
    EXPECT_EQ(nudged_region({4, 4, 8, 8}, {100, -100}, picture), QRect(56, 0, 8, 8));
    EXPECT_EQ(grown_region({4, 4, 8, 8}, {-100, 100}, picture), QRect(4, 4, 1, 44));
}

/// Draws in a pane and measures what was drawn.
double rmse_of_drawn(CompareView& compare, ImageView& pane, const QRectF& where) {
    QRect drawn;
    const auto connection = QObject::connect(&compare.panes(), &PaneBoard::region_changed,
                                             [&](QSize, QRect region) { drawn = region; });
    compare.panes().set_region({}, {});
    drag(pane, where.topLeft(), where.bottomRight());
    QObject::disconnect(connection);
    EXPECT_FALSE(drawn.isEmpty());
    if (drawn.isEmpty()) return -1;
    const std::atomic<bool> never{false};
    const auto result =
        measure(request_of(compare.compared().pictures[0], compare.compared().pictures[1], drawn), never);
    EXPECT_TRUE(result.refusal.isEmpty()) << result.refusal.toStdString();
    return result.rectangle->values.at("rmse");
}

TEST(RectangleInModes, IsTheSamePlaceEverywhere) {
    CompareView compare(nullptr, ImageView::Surface::raster);
    compare.set_pictures({radiance(with_error(ramp(64, 48)), "ours"), radiance(ramp(64, 48), "truth")});
    show(compare, {900, 500});
    compare.panes().set_tool(Tool::rectangle);
    for (const Mode mode :
         {Mode::single, Mode::side_by_side, Mode::wipe, Mode::flip, Mode::difference, Mode::stages}) {
        compare.set_mode(mode);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !compare.is_computing(); }, 60000));
        compare.active_view().fit();
        auto panes = compare.views();
        for (auto* each : compare.difference_views()) panes.push_back(each);
        for (auto* pane : panes) {
            EXPECT_NEAR(rmse_of_drawn(compare, *pane, {4.5, 4.5, 20, 14}), 0.05, 1e-5) << int(mode);
            EXPECT_EQ(rmse_of_drawn(compare, *pane, {38.5, 30.5, 20, 14}), 0) << int(mode);
            for (auto* other : panes)
                EXPECT_EQ(other->state().marks.region, pane->state().marks.region) << int(mode);
        }
    }
}

}  // namespace
}  // namespace ir::widgets
