#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>

#include "widgets/benchmarks/benchmark_panel.h"
#include "widgets/panels/empty_tree_view.h"

namespace ir::widgets {
namespace {

using State = BenchmarkLine::State;

BenchmarkLine measured(const QString& label, double ms, double bytes, bool best) {
    BenchmarkLine line;
    line.label = label;
    line.state = State::measured;
    line.cells = {{QString::number(ms), ms, best}, {QString::number(bytes), bytes, false}};
    return line;
}

class BenchmarkPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        fields.benchmarks = {{"storages", "storages", "All storages."}, {"other", "other", "Another."}};
        fields.places = {{"own", "Its scene: builtin:atrium", {}}, {"experiment", "Scene of A", {}}};
        fields.benchmark = "storages";
        fields.place = "own";
        fields.table.headings = QStringList{"Build [ms]", "Memory [MB]"};
        fields.table.docs = QStringList{"Of all maps.", "With spare."};
        fields.table.lines = {measured("arrays", 12, 300, true), measured("lists", 140, 20, false)};
        BenchmarkLine failed;
        failed.label = "bricks";
        failed.state = State::failed;
        failed.problem = "needs 33 GB, more than there is";
        failed.cells = {{}, {}};
        fields.table.lines.push_back(failed);
        auto peer = measured("embree", 40, 0, false);
        peer.is_peer = true;
        peer.cells[1] = {};
        fields.table.lines.push_back(peer);
        fields.has_numbers = true;
        fields.foot = "on an abacus";
        panel.resize(760, 240);
        panel.set_fields(fields);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        QApplication::setActiveWindow(&panel);
        panel.view().setFocus();
    }
    template <class Widget>
    Widget* find(const char* name) {
        return panel.findChild<Widget*>(QLatin1String(name));
    }
    QModelIndex at(int row, int column) { return panel.view().model()->index(row, column); }
    QString label(int row) { return at(row, 0).data().toString(); }
    void click_heading(int column) {
        auto* header = panel.view().header();
        QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                          {header->sectionViewportPosition(column) + 20, header->height() / 2});
    }

    BenchmarkFields fields;
    BenchmarkPanel panel;
};

TEST_F(BenchmarkPanelTest, ShowsNumbersTheBestAndWhatFailed) {
    EXPECT_EQ(at(0, 1).data().toString(), "12");
    EXPECT_TRUE(at(0, 1).data(Qt::FontRole).value<QFont>().bold());
    EXPECT_FALSE(at(1, 1).data(Qt::FontRole).value<QFont>().bold());
    EXPECT_TRUE(label(2).contains("33 GB"));
    EXPECT_TRUE(panel.view().isFirstColumnSpanned(2, {}));
    EXPECT_FALSE(panel.view().isFirstColumnSpanned(1, {}));
    auto* model = panel.view().model();
    EXPECT_EQ(model->headerData(1, Qt::Horizontal, Qt::ToolTipRole).toString(), "Of all maps.");
    EXPECT_EQ(find<QComboBox>("benchmark")->toolTip(), "All storages.");
    EXPECT_EQ(find<QLabel>("foot")->text(), "on an abacus");
    EXPECT_FALSE(at(3, 0).flags() & Qt::ItemIsUserCheckable) << "peers run with the variants";
}

TEST_F(BenchmarkPanelTest, SortsByNumberWithEmptyCellsLast) {
    click_heading(1);
    EXPECT_EQ(label(0), "arrays");
    EXPECT_EQ(label(1), "embree (peer)") << "40 is less than 140";
    EXPECT_EQ(label(2), "lists");
    EXPECT_TRUE(panel.view().isFirstColumnSpanned(3, {}));
    click_heading(1);
    EXPECT_EQ(label(0), "lists");
    EXPECT_TRUE(label(3).startsWith("bricks")) << "last in either order";
    EXPECT_TRUE(panel.view().isFirstColumnSpanned(3, {}));
    EXPECT_FALSE(panel.view().isFirstColumnSpanned(2, {}));
    click_heading(1);
    EXPECT_EQ(label(0), "arrays") << "the third click brings back the benchmark's order";
    EXPECT_EQ(label(1), "lists");
}

TEST_F(BenchmarkPanelTest, VariantsAreChosenByKey) {
    QSignalSpy chosen(&panel, &BenchmarkPanel::variants_chosen);
    panel.view().setCurrentIndex(at(1, 0));
    QTest::keyClick(&panel.view(), Qt::Key_Space);
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toStringList(), (QStringList{"arrays", "bricks"}));
    panel.findChild<QAction*>("check-none")->trigger();
    EXPECT_TRUE(chosen.last()[0].toStringList().isEmpty());
    panel.findChild<QAction*>("check-all")->trigger();
    EXPECT_EQ(chosen.last()[0].toStringList().size(), 3);
}

TEST_F(BenchmarkPanelTest, CopiesTheChosenRowsOrAll) {
    QTest::keyClick(&panel.view(), Qt::Key_C, Qt::ControlModifier);
    const auto all = QApplication::clipboard()->text().split('\n');
    ASSERT_EQ(all.size(), 5);
    EXPECT_EQ(all[0], "Variant\tBuild [ms]\tMemory [MB]");
    EXPECT_EQ(all[2], "lists\t140\t20");
    panel.view().setCurrentIndex(at(1, 0));
    QTest::keyClick(&panel.view(), Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(QApplication::clipboard()->text().split('\n').size(), 2);
}

TEST_F(BenchmarkPanelTest, RunsAndCancels) {
    QSignalSpy run(&panel, &BenchmarkPanel::run_wanted), cancel(&panel, &BenchmarkPanel::cancel_wanted);
    QTest::mouseClick(find<QToolButton>("run"), Qt::LeftButton);
    EXPECT_EQ(run.count(), 1);
    QTest::keyClick(&panel.view(), Qt::Key_Escape);
    EXPECT_EQ(cancel.count(), 0);
    fields.is_running = true;
    fields.doing = "1 of 3: arrays, cold run";
    fields.fraction = 0.25;
    panel.set_fields(fields);
    EXPECT_EQ(find<QToolButton>("run")->text(), "Cancel");
    EXPECT_EQ(find<QProgressBar>("progress")->value(), 250);
    EXPECT_FALSE(find<QComboBox>("benchmark")->isEnabled());
    EXPECT_FALSE(at(0, 0).flags() & Qt::ItemIsUserCheckable);
    QTest::keyClick(&panel.view(), Qt::Key_Escape);
    EXPECT_EQ(cancel.count(), 1);
    QTest::mouseClick(find<QToolButton>("run"), Qt::LeftButton);
    EXPECT_EQ(cancel.count(), 2);
    EXPECT_EQ(run.count(), 1);
}

TEST_F(BenchmarkPanelTest, EscapeReachesThePanelBeforeTheWindowsShortcut) {
    QAction window_wide(&panel);
    window_wide.setShortcut(Qt::Key_Escape);
    panel.addAction(&window_wide);
    QSignalSpy other(&window_wide, &QAction::triggered), cancel(&panel, &BenchmarkPanel::cancel_wanted);
    fields.is_running = true;
    panel.set_fields(fields);
    QTest::keyClick(&panel.view(), Qt::Key_Escape);
    EXPECT_EQ(cancel.count(), 1);
    EXPECT_EQ(other.count(), 0);
    fields.is_running = false;
    panel.set_fields(fields);
    QTest::keyClick(&panel.view(), Qt::Key_Escape);
    EXPECT_EQ(other.count(), 1);
}

TEST_F(BenchmarkPanelTest, SettingFieldsEmitsNothing) {
    QSignalSpy repeats(&panel, &BenchmarkPanel::repeats_chosen),
        variants(&panel, &BenchmarkPanel::variants_chosen);
    fields.repeats = 9;
    fields.table.lines[0].is_chosen = false;
    fields.why_not_run = "No variant is checked.";
    fields.has_numbers = false;
    panel.set_fields(fields);
    EXPECT_EQ(repeats.count() + variants.count(), 0);
    EXPECT_EQ(find<QSpinBox>("repeats")->value(), 9);
    EXPECT_FALSE(find<QToolButton>("run")->isEnabled());
    EXPECT_TRUE(find<QToolButton>("run")->toolTip().contains("No variant is checked."));
    EXPECT_FALSE(find<QToolButton>("export")->isEnabled());
    find<QSpinBox>("repeats")->setValue(3);
    EXPECT_EQ(repeats.count(), 1);
}

TEST_F(BenchmarkPanelTest, TheSelectionStaysWhileRowsArrive) {
    panel.view().setCurrentIndex(at(1, 0));
    fields.table.lines[0].cells[0].text = "13";
    panel.set_fields(fields);
    EXPECT_EQ(panel.view().currentIndex().row(), 1);
    EXPECT_EQ(at(0, 1).data().toString(), "13");
}

}  // namespace
}  // namespace ir::widgets
