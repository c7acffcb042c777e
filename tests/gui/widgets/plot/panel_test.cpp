#include <gtest/gtest.h>

#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QToolButton>

#include "tests/gui/widgets/plot/sample.h"
#include "widgets/panels/empty_tree_view.h"
#include "widgets/plot/plot_panel.h"

namespace ir::widgets {
namespace {

class PlotPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        choices.plots = {{"a", "Plot A", {}}, {"b", "Plot B", {}}};
        choices.plot = "a";
        choices.metrics = {{"rmse", "RMSE", {}}, {"flip", "FLIP", {}}};
        choices.metric = "rmse";
        choices.keys = {{"frames", "Frames", {}}, {"directions", "Directions", {}}};
        choices.key = "directions";
        choices.values = "32, 64";
        choices.has_numbers = true;
        panel.header().show_choices(choices);
        panel.show_data(sample_plot(), {});
        panel.resize(900, 420);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        QApplication::setActiveWindow(&panel);
        QApplication::processEvents();
    }
    template <class Widget>
    Widget* find(const char* name) {
        return panel.findChild<Widget*>(QLatin1String(name));
    }
    QString row_text(int row, int column) {
        return panel.table().model()->index(row, column).data().toString();
    }

    PlotChoices choices;
    PlotPanel panel;
};

TEST_F(PlotPanelTest, PlotAndTableHaveOneSelection) {
    auto& table = panel.table();
    QTest::mouseClick(&panel.view(), Qt::LeftButton, {}, panel.view().position_of("g1").toPoint());
    EXPECT_EQ(table.currentIndex().data(PlotTableModel::id_role).toString(), "g1");
    EXPECT_TRUE(find<QLabel>("point")->text().contains("point g1"));
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_Up);
    EXPECT_EQ(panel.selected(), "f3");
    QSignalSpy activated(&panel, &PlotPanel::point_activated);
    QTest::keyClick(&table, Qt::Key_Return);
    ASSERT_EQ(activated.count(), 1);
    EXPECT_EQ(activated[0][0].toString(), "f3");
}

TEST_F(PlotPanelTest, TheTableIsSortedByNumbersAndKeepsTheSelection) {
    panel.select("f2");
    panel.table().sortByColumn(1, Qt::DescendingOrder);
    EXPECT_EQ(row_text(0, 1), "2000");
    EXPECT_EQ(row_text(1, 1), "100");  // as texts 90 would be the largest
    EXPECT_EQ(row_text(2, 1), "90");
    EXPECT_EQ(panel.selected(), "f2");
    auto data = sample_plot();
    data.series[0].points.push_back(sample_point("f4", 3000, 0.01));
    panel.show_data(data, {});
    EXPECT_EQ(row_text(0, 1), "3000");
    EXPECT_EQ(panel.selected(), "f2");
    EXPECT_EQ(panel.table().currentIndex().data(PlotTableModel::id_role).toString(), "f2");
}

TEST_F(PlotPanelTest, HeadingsStandAsTheirCells) {
    const auto& model = *panel.table().model();
    for (int column = 0; column < model.columnCount(); ++column)
        EXPECT_EQ(model.headerData(column, Qt::Horizontal, Qt::TextAlignmentRole),
                  model.index(0, column).data(Qt::TextAlignmentRole))
            << column;
}

TEST_F(PlotPanelTest, RowsAreCopiedAsText) {
    panel.select("f1");
    panel.table().setFocus();
    QTest::keySequence(&panel.table(), QKeySequence::Copy);
    EXPECT_EQ(QApplication::clipboard()->text(), "f1\t1\t0.2");
}

TEST_F(PlotPanelTest, ProblemsRemarksAndNotesAreListed) {
    auto* lines = find<QListWidget>("lines");
    EXPECT_FALSE(lines->isVisible());
    auto data = sample_plot();
    data.problems = {"fast, Directions = 3: directions must be at least 4"};
    data.notes = {"the reference was rendered"};
    data.series[0].points.push_back(sample_point("zero", 5, 0));
    panel.show_data(data, {});
    ASSERT_EQ(lines->count(), 3);
    EXPECT_TRUE(lines->isVisible());
    EXPECT_EQ(lines->item(0)->text().toStdString(), data.problems[0]);
    EXPECT_TRUE(lines->item(1)->text().contains("hollow"));
    EXPECT_EQ(lines->item(2)->text().toStdString(), data.notes[0]);
}

TEST_F(PlotPanelTest, LongLinesAreWrapped) {
    auto data = sample_plot();
    data.notes = {"short",
                  "the reference has an RMSE of about 0.00345 left of its own; smaller errors against it say "
                  "nothing, and so on until no panel is wide enough for one line of text that holds it all"};
    panel.show_data(data, {});
    QApplication::processEvents();
    auto* lines = find<QListWidget>("lines");
    EXPECT_GE(lines->visualItemRect(lines->item(1)).height(),
              lines->visualItemRect(lines->item(0)).height() + lines->fontMetrics().height());
    EXPECT_TRUE(lines->viewport()->rect().contains(lines->visualItemRect(lines->item(1))))
        << "nothing is cut";
}

/// Thirty rows, far more than the panel is high.
TEST_F(PlotPanelTest, EachRowOfBarsHasItsNameAndIsScrolledTo) {
    PlotData data;
    data.title = "Bars";
    data.are_bars = true;
    data.headings = {"Row"};
    data.series = {{"", {}}};
    for (int row = 0; row < 30; ++row) {
        data.y.names.push_back("row " + std::to_string(row));
        auto& point = data.series[0].points.emplace_back(sample_point(data.y.names.back().c_str(), 1, row));
        point.cells = {{data.y.names.back()}};
    }
    panel.show_data(data, {});
    QApplication::processEvents();
    const auto& plot = panel.view().drawing().plot();
    ASSERT_EQ(plot.y.ticks().size(), 30u);
    EXPECT_GE(panel.view().drawing().area().height() / 30, panel.fontMetrics().ascent());
    for (const auto& tick : plot.y.ticks())
        EXPECT_EQ(tick.text, "row " + std::to_string(int(tick.place))) << "at its own bar";
    const auto is_seen = [&](const char* id) {
        return panel.view().visibleRegion().contains(panel.view().position_of(QLatin1String(id)).toPoint());
    };
    EXPECT_FALSE(is_seen("row 2"));
    panel.select("row 2");
    QApplication::processEvents();
    EXPECT_TRUE(is_seen("row 2"));
    panel.table().setFocus();
    QTest::keyClick(&panel.table(), Qt::Key_Home);
    EXPECT_TRUE(is_seen("row 29"));
    panel.show_data(sample_plot(), {});
    QApplication::processEvents();
    EXPECT_LE(panel.view().height(), panel.height()) << "what is no bars has the height that there is";
}

TEST_F(PlotPanelTest, AnEmptyPanelSaysWhatAPlotIsAndOffersOne) {
    panel.show_empty("What a plot is", "New plot");
    auto* button = find<QPushButton>("empty-button");
    ASSERT_TRUE(button->isVisible());
    EXPECT_EQ(find<QLabel>("empty")->text(), "What a plot is");
    QSignalSpy clicked(&panel, &PlotPanel::button_clicked);
    button->click();
    EXPECT_EQ(clicked.count(), 1);
    panel.show_empty("No project is open.");
    EXPECT_FALSE(button->isVisible());
    PlotData waiting = sample_plot();
    waiting.series.clear();
    panel.show_data(waiting, "Run the plot.");
    EXPECT_TRUE(find<QLabel>("waiting")->isVisible());
    panel.show_data(sample_plot(), "Run the plot.");
    EXPECT_FALSE(find<QLabel>("waiting")->isVisible());
}

TEST_F(PlotPanelTest, TheHeaderEmitsWhatAPersonChooses) {
    auto& header = panel.header();
    QSignalSpy metric(&header, &PlotHeader::metric_chosen), key(&header, &PlotHeader::key_chosen),
        values(&header, &PlotHeader::values_chosen), axis(&header, &PlotHeader::against_time_chosen),
        log(&header, &PlotHeader::log_chosen), run(&header, &PlotHeader::run_wanted),
        cancel(&header, &PlotHeader::cancel_wanted);
    header.show_choices(choices);
    EXPECT_EQ(metric.count() + key.count() + values.count() + axis.count() + log.count(), 0);
    auto* metrics = find<QComboBox>("metric");
    metrics->setFocus();
    QTest::keyClick(metrics, Qt::Key_Down);
    ASSERT_EQ(metric.count(), 1);
    EXPECT_EQ(metric[0][0].toString(), "flip");
    auto* typed = find<QLineEdit>("values");
    typed->setFocus();
    typed->selectAll();
    QTest::keyClicks(typed, "1, 2, 4");
    QTest::keyClick(typed, Qt::Key_Return);
    ASSERT_EQ(values.count(), 1);
    EXPECT_EQ(values[0][0].toString(), "1, 2, 4");
    QTest::mouseClick(find<QToolButton>("log-y"), Qt::LeftButton);
    ASSERT_EQ(log.count(), 1);
    EXPECT_TRUE(log[0][0].toBool());
    EXPECT_FALSE(log[0][1].toBool());
    QTest::mouseClick(find<QToolButton>("plot-run"), Qt::LeftButton);
    EXPECT_EQ(run.count(), 1);
    choices.is_running = true;
    choices.fraction = 0.25;
    header.show_choices(choices);
    EXPECT_TRUE(find<QProgressBar>("progress")->isVisible());
    EXPECT_EQ(find<QProgressBar>("progress")->value(), 250);
    QTest::mouseClick(find<QToolButton>("plot-run"), Qt::LeftButton);
    EXPECT_EQ(cancel.count(), 1);
}

TEST_F(PlotPanelTest, WhatCannotBeDoneSaysWhy) {
    auto& header = panel.header();
    EXPECT_FALSE(find<QLabel>("stale")->isVisible());
    choices.stale = "Changed: directions";
    choices.why_not_run = "Choose experiments.";
    choices.why_no_log_x = "The values are no numbers.";
    choices.has_numbers = false;
    header.show_choices(choices);
    EXPECT_TRUE(find<QLabel>("stale")->isVisible());
    EXPECT_EQ(find<QLabel>("stale")->toolTip(), "Changed: directions");
    EXPECT_FALSE(find<QToolButton>("plot-run")->isEnabled());
    EXPECT_TRUE(find<QToolButton>("plot-run")->toolTip().contains("Choose experiments."));
    EXPECT_FALSE(find<QToolButton>("log-x")->isEnabled());
    EXPECT_TRUE(find<QToolButton>("log-x")->toolTip().contains("no numbers"));
    EXPECT_FALSE(find<QToolButton>("plot-export")->isEnabled());
    choices.why_read_only = "Somebody else has it.";
    header.show_choices(choices);
    EXPECT_FALSE(find<QComboBox>("metric")->isEnabled());
    EXPECT_TRUE(find<QComboBox>("plot")->isEnabled()) << "looking changes nothing";
    EXPECT_TRUE(find<QToolButton>("plot-add")->toolTip().contains("Somebody else"));
}

TEST_F(PlotPanelTest, TheTableStandsBesideOrBelow) {
    const auto apart = [this] {
        QApplication::processEvents();
        return panel.table().mapTo(&panel, QPoint()) - panel.view().mapTo(&panel, QPoint());
    };
    EXPECT_GT(apart().x(), 200);
    panel.resize(360, 700);
    EXPECT_GT(apart().y(), 150);
    EXPECT_EQ(apart().x(), 0);
}

}  // namespace
}  // namespace ir::widgets
