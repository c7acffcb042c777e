#include <gtest/gtest.h>

#include <QPainter>
#include <QSignalSpy>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/gui/widgets/plot/sample.h"
#include "tests/processor_time.h"
#include "widgets/plot/plot_painter.h"
#include "widgets/plot/plot_view.h"

namespace ir::widgets {
namespace {

class PlotViewTest : public testing::Test {
  protected:
    void SetUp() override {
        view.set_data(sample_plot());
        view.resize(640, 400);
        view.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
        QApplication::setActiveWindow(&view);
        view.setFocus();
        QApplication::processEvents();
    }
    QPoint at(const char* id) { return view.position_of(id).toPoint(); }
    void click(const QPoint& place) { QTest::mouseClick(&view, Qt::LeftButton, {}, place); }
    QImage grab() {
        QApplication::processEvents();
        return view.grab().toImage();
    }

    PlotView view;
    QSignalSpy selected{&view, &PlotView::selected_changed};
    QSignalSpy activated{&view, &PlotView::activated};
};

TEST_F(PlotViewTest, PointsStandWhereTheAxesPutTheirValues) {
    const auto& area = view.drawing().area();
    const auto& plot = view.drawing().plot();
    ASSERT_EQ(view.marks().size(), 5u);
    for (const auto& mark : view.marks()) {
        const auto place = view.position_of(QString::fromStdString(mark.id));
        EXPECT_TRUE(area.contains({place.x(), place.y()})) << mark.id;
        EXPECT_TRUE(view.rect().contains(place.toPoint())) << mark.id;
    }
    // The grid's lines stand at their values: a point of 10 ms upon that of 10 ms.
    const auto image = grab();
    const auto lines = [&](int x) {
        return count_like(image, colour_of(PlotStyle::screen().grid),
                          QRect(x, int(area.top), 1, int(area.height())));
    };
    for (const auto& tick : plot.x.ticks()) {
        const double share = (tick.place - plot.x.low()) / (plot.x.high() - plot.x.low());
        const int x = int(area.left + share * area.width());
        EXPECT_GT(std::max({lines(x - 1), lines(x), lines(x + 1)}), area.height() / 3) << tick.text;
        if (tick.text == "10") {
            EXPECT_NEAR(view.position_of("f2").x(), x, 1);
        }
    }
    // One decade of time is half of two, and so is one of error.
    EXPECT_NEAR(at("f2").x() - at("f1").x(), at("f3").x() - at("f2").x(), 1.5);
    EXPECT_LT(at("f2").x(), at("g1").x());
    EXPECT_GT(at("g2").y(), at("f1").y());
}

TEST_F(PlotViewTest, EveryPointIsDrawnInItsColourWithItsRing) {
    const auto image = grab();
    const auto& style = PlotStyle::screen();
    for (const auto& mark : view.marks()) {
        const QRect around(view.position_of(QString::fromStdString(mark.id)).toPoint() - QPoint(4, 4),
                           QSize(9, 9));
        EXPECT_GT(count_like(image, colour_of(style.series(mark.series)), around), 20) << mark.id;
    }
    const auto ring = [&](const char* id) {
        return count_like(image, colour_of(style.front), QRect(at(id) - QPoint(9, 9), QSize(19, 19)));
    };
    EXPECT_GT(ring("f1"), 8);
    EXPECT_EQ(ring("f3"), 0);
}

TEST_F(PlotViewTest, AClickOnAPointSelectsAndActivatesIt) {
    click(at("g1"));
    ASSERT_EQ(activated.count(), 1);
    EXPECT_EQ(activated[0][0].toString(), "g1");
    ASSERT_EQ(selected.count(), 1);
    EXPECT_EQ(view.selected(), "g1");
    click(at("g1") + QPoint(3, -2));  // nearly
    EXPECT_EQ(activated.count(), 2);
    click({view.width() - 30, 100});  // nothing there
    EXPECT_EQ(activated.count(), 2);
    QTest::mousePress(&view, Qt::LeftButton, {}, at("f1"));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, at("g2"));
    EXPECT_EQ(activated.count(), 2) << "dragged from one point to another";
}

TEST_F(PlotViewTest, HoveringTellsWhatAPointIs) {
    QTest::mouseMove(&view, at("f2"));
    ASSERT_TRUE(QTest::qWaitFor([] { return QToolTip::isVisible(); }, 60000));
    EXPECT_EQ(QToolTip::text(), "point f2\n10 ms");
    EXPECT_EQ(view.cursor().shape(), Qt::PointingHandCursor);
    QTest::mouseMove(&view, {view.width() - 30, 100});
    EXPECT_TRUE(QTest::qWaitFor([this] { return view.cursor().shape() == Qt::ArrowCursor; }, 60000));
}

TEST_F(PlotViewTest, KeysWalkThroughPointsAndEnterTakesOne) {
    const auto walk = [this](Qt::Key key) {
        QTest::keyClick(&view, key);
        return view.selected().toStdString();
    };
    QTest::keyClick(&view, Qt::Key_Return);
    EXPECT_EQ(activated.count(), 0) << "nothing is selected";
    EXPECT_EQ(walk(Qt::Key_Right), "f1");
    EXPECT_EQ(walk(Qt::Key_Right), "f2");
    EXPECT_EQ(walk(Qt::Key_Left), "f1");
    EXPECT_EQ(walk(Qt::Key_Left), "f1");
    EXPECT_EQ(walk(Qt::Key_End), "f3");
    EXPECT_EQ(walk(Qt::Key_Down), "g1") << "the nearest of the next series";
    EXPECT_EQ(walk(Qt::Key_Right), "g2");
    EXPECT_EQ(walk(Qt::Key_Up), "f3");
    EXPECT_EQ(walk(Qt::Key_Home), "f1");
    QTest::keyClick(&view, Qt::Key_Return);
    ASSERT_EQ(activated.count(), 1);
    EXPECT_EQ(activated[0][0].toString(), "f1");
}

TEST_F(PlotViewTest, ZeroOnALogarithmicAxisStandsHollowAtTheEdgeAndIsSaid) {
    auto data = sample_plot();
    data.series[0].points.push_back(sample_point("zero", 50, 0));
    view.set_data(data);
    QApplication::processEvents();
    EXPECT_NEAR(view.position_of("zero").y(), view.drawing().area().bottom, 1.5);
    ASSERT_EQ(view.drawing().plot().remarks.size(), 1u);
    EXPECT_TRUE(view.drawing().plot().remarks[0].find("hollow") != std::string::npos)
        << view.drawing().plot().remarks[0];
    click(at("zero"));
    EXPECT_EQ(activated.count(), 1);
    data.y.log = false;
    view.set_data(data);
    EXPECT_TRUE(view.drawing().plot().remarks.empty());
}

TEST_F(PlotViewTest, WhatHasNoNumberIsSaidAndALevelFarBelowIsNotDrawn) {
    auto data = sample_plot();
    data.series[0].points.push_back(sample_point("unknown", 50, std::nan("")));
    data.level->y = 1e-9;
    view.set_data(data);
    EXPECT_EQ(view.marks().size(), 5u);
    EXPECT_EQ(view.drawing().plot().remarks.size(), 2u);
    EXPECT_TRUE(view.drawing().plot().remarks[0].find("10⁻⁹") != std::string::npos);
}

TEST_F(PlotViewTest, EmptyPlotsAndSinglePointsAreDrawn) {
    auto data = sample_plot();
    data.series.clear();
    view.set_data(data);
    EXPECT_FALSE(grab().isNull());
    EXPECT_TRUE(view.point_at({100, 100}).isEmpty());
    QTest::keyClick(&view, Qt::Key_Right);
    EXPECT_TRUE(view.selected().isEmpty());
    data.series = {{"one", {sample_point("a", 3, 0.5)}}};
    data.level.reset();
    view.set_data(data);
    grab();
    const auto& area = view.drawing().area();
    EXPECT_NEAR(view.position_of("a").x(), (area.left + area.right) / 2, 2);
}

TEST_F(PlotViewTest, ThousandsOfPointsAreQuick) {
    auto data = sample_plot();
    for (int i = 0; i < 5000; ++i)
        data.series[std::size_t(i % 2)].points.push_back(
            sample_point(std::to_string(i), 1 + i, 0.01 + 0.1 / (1 + i)));
    const double start = processor_seconds();
    view.set_data(data);
    grab();
    QTest::mouseMove(&view, {300, 200});
    EXPECT_LT(processor_seconds() - start, 3);
    EXPECT_EQ(view.marks().size(), 5005u);
}

TEST_F(PlotViewTest, PicturesHaveTheAskedSizeAndBothGrounds) {
    const auto paper = plot_picture(sample_plot(), {500, 320}, 1, PlotStyle::paper());
    EXPECT_EQ(paper.size(), QSize(500, 320));
    EXPECT_EQ(paper.pixelColor(1, 1), QColor(Qt::white));
    for (int s = 0; s < 2; ++s)
        EXPECT_GT(count_like(paper, colour_of(PlotStyle::paper().series(s)), paper.rect()), 100) << s;
    EXPECT_GT(count_like(paper, colour_of(PlotStyle::paper().text), QRect(0, 0, 500, 30)), 50) << "the title";
    EXPECT_GT(count_like(paper, colour_of(PlotStyle::paper().text), QRect(0, 60, 60, 240)), 60)
        << "the vertical axis";
    EXPECT_GT(count_like(paper, colour_of(PlotStyle::paper().text), QRect(0, 296, 500, 24)), 30)
        << "the horizontal axis";
    const auto fine = plot_picture(sample_plot(), {500, 320}, 2, PlotStyle::screen());
    EXPECT_EQ(fine.size(), QSize(1000, 640));
    EXPECT_EQ(fine.pixelColor(1, 1), colour_of(PlotStyle::screen().background));
    EXPECT_GT(count_like(fine, colour_of(PlotStyle::screen().series(0)), fine.rect()), 400);
}

TEST_F(PlotViewTest, WhatWasShownBeforeLeavesNothingBehind) {
    const auto fresh = grab();
    auto other = sample_plot();
    other.x = {"Directions", false, {"a", "b", "c"}, {}};
    other.y.log = false;
    view.set_data(other);
    view.resize(500, 300);
    EXPECT_NE(grab(), fresh);
    view.resize(640, 400);
    view.set_data(sample_plot());
    EXPECT_EQ(grab(), fresh);
}

TEST(PlotStyle, SeriesDifferInColourOrMark) {
    for (const auto* style : {&PlotStyle::screen(), &PlotStyle::paper()}) {
        std::vector<QImage> marks;
        for (int s = 0; s < 40; ++s) {
            QImage image(24, 24, QImage::Format_RGB32);
            image.fill(colour_of(style->background));
            QPainter painter(&image);
            PlotPainter canvas({}, &painter);
            draw_plot_mark(canvas, {12, 12}, s, 6, *style);
            painter.end();
            for (const auto& other : marks) EXPECT_NE(image, other) << s;
            marks.push_back(image);
        }
    }
}

}  // namespace
}  // namespace ir::widgets
