#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QSignalSpy>
#include <QTest>

#include "widgets/panels/empty_tree_view.h"
#include "widgets/results/results_panel.h"

namespace ir::widgets {
namespace {

class ResultsPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        for (int i = 0; i < 3; ++i) {
            ResultRow row;
            row.key = QStringLiteral("k%1").arg(i);
            row.experiment = QStringLiteral("Experiment %1").arg(i);
            row.date = QDateTime(QDate(2026, 1, 3 - i), QTime(12, 0), Qt::UTC);
            rows.push_back(row);
        }
        panel.set_rows(rows);
        panel.resize(700, 400);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        QApplication::setActiveWindow(&panel);
        panel.view().setFocus();
    }
    QString tip(const char* name) { return panel.action(name)->toolTip(); }

    std::vector<ResultRow> rows;
    ResultsPanel panel;
};

TEST_F(ResultsPanelTest, ActionsSayWhyTheyCannot) {
    for (const char* name : {"show-a", "show-b", "changes", "reveal", "delete"}) {
        EXPECT_FALSE(panel.action(name)->isEnabled()) << name;
        EXPECT_TRUE(tip(name).contains("Choose")) << tip(name).toStdString();
    }
    panel.select({"k1"});
    for (const char* name : {"show-a", "show-b", "changes", "reveal", "delete"})
        EXPECT_TRUE(panel.action(name)->isEnabled()) << name;
    panel.select({"k0", "k1"});
    EXPECT_FALSE(panel.action("show-a")->isEnabled());
    EXPECT_TRUE(panel.action("changes")->isEnabled());
    panel.select({"k0", "k1", "k2"});
    EXPECT_FALSE(panel.action("changes")->isEnabled());
    EXPECT_TRUE(panel.action("delete")->isEnabled());
    panel.set_read_only("Somebody else has it.");
    EXPECT_FALSE(panel.action("delete")->isEnabled());
    EXPECT_TRUE(tip("delete").contains("Somebody else"));
}

TEST_F(ResultsPanelTest, KeysShowCompareAndDelete) {
    QSignalSpy shown(&panel, &ResultsPanel::show_wanted), changes(&panel, &ResultsPanel::changes_wanted),
        deleted(&panel, &ResultsPanel::delete_wanted);
    panel.select({"k2", "k0"});
    QTest::keyClick(&panel.view(), Qt::Key_Return, Qt::ControlModifier);
    ASSERT_EQ(changes.count(), 1);
    EXPECT_EQ(changes[0][0].toStringList(), (QStringList{"k2", "k0"}));  // the older one first
    panel.select({"k1"});
    QTest::keyClick(&panel.view(), Qt::Key_Return);
    QTest::keyClick(&panel.view(), Qt::Key_Return, Qt::ShiftModifier);
    ASSERT_EQ(shown.count(), 2);
    EXPECT_EQ(shown[0][0].toString(), "k1");
    EXPECT_FALSE(shown[0][1].toBool());
    EXPECT_TRUE(shown[1][1].toBool());
    QTest::keyClick(&panel.view(), Qt::Key_Delete);
    ASSERT_EQ(deleted.count(), 1);
    EXPECT_EQ(deleted[0][0].toStringList(), QStringList{"k1"});
}

TEST_F(ResultsPanelTest, TheSelectionStaysWhenRowsChange) {
    panel.select({"k1"});
    rows[1].state = ResultRow::State::stale;
    rows.erase(rows.begin());
    const QSignalSpy selected(&panel, &ResultsPanel::selection_changed);
    panel.set_rows(rows);
    EXPECT_EQ(panel.selected(), QStringList{"k1"});
    EXPECT_EQ(selected.count(), 0);
    std::swap(rows[0], rows[1]);
    panel.set_rows(rows);
    EXPECT_EQ(panel.selected(), QStringList{"k1"});
}

TEST_F(ResultsPanelTest, AnEmptyTableSaysWhy) {
    panel.set_empty_text("Nothing yet.");
    panel.findChild<QLineEdit*>("filter")->setText("vault");
    EXPECT_TRUE(panel.view().empty_text().contains("filter"));
    panel.set_rows({});
    EXPECT_EQ(panel.view().empty_text(), "Nothing yet.");
}

TEST_F(ResultsPanelTest, ChangesAreListedAndCopied) {
    auto* list = panel.findChild<QListWidget*>("changes-list");
    EXPECT_FALSE(list->isVisible());
    panel.show_changes("From a to b", {"seed: 1 → 2", "frames: 1 → 8"}, "Nothing.");
    EXPECT_TRUE(list->isVisible());
    EXPECT_EQ(list->count(), 2);
    EXPECT_EQ(panel.findChild<QLabel*>("changes-title")->text(), "From a to b");
    list->setFocus();
    QTest::keyClick(list, Qt::Key_C, Qt::ControlModifier);
    EXPECT_EQ(QApplication::clipboard()->text(), "From a to b\nseed: 1 → 2\nframes: 1 → 8");
    panel.show_changes("From a to a", {}, "Nothing.");
    EXPECT_EQ(list->item(0)->text(), "Nothing.");
    panel.hide_changes();
    EXPECT_FALSE(list->isVisible());
}

}  // namespace
}  // namespace ir::widgets
