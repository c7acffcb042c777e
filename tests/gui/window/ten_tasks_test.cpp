// Ten everyday tasks and how many steps by mouse and keys each takes (docs/testing.md). Menus, file dialogs
// and the form of a sweep are counted and not clicked: they have tests of their own.
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTabBar>

#include "tests/gui/window/sweeps_fixture.h"
#include "widgets/panels/finder_dialog.h"

namespace ir::gui {
namespace {

using widgets::ViewMode;

/// A step is a key with what is held, a click, a drag, a place that is pointed at, or a text that is typed.
class TenTasks : public SweepsWindowTest {
  protected:
    void SetUp() override {
        SweepsWindowTest::SetUp();
        window.docks().restore_default();
        ASSERT_TRUE(settle());
    }
    /// The keys that menus name beside an action, in the window.
    void press(const char* action) {
        ++count;
        const auto* pressed = window.action(action);
        ASSERT_TRUE(pressed->isEnabled()) << action;
        ASSERT_FALSE(pressed->shortcut().isEmpty()) << action;
        ASSERT_TRUE(activate(window));
        window.view().setFocus();
        QTest::keySequence(&window.view(), pressed->shortcut());
        ASSERT_TRUE(settle());
    }
    void key(QWidget* widget, Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
        ++count;
        QTest::keyClick(widget, key, modifiers);
        ASSERT_TRUE(settle());
    }
    void type(QWidget* field, const char* text) {
        ++count;
        if (auto* line = qobject_cast<QLineEdit*>(field)) line->selectAll();
        QTest::keyClicks(field, text);
    }
    void click(QWidget* widget) {
        ++count;
        ASSERT_TRUE(widget);
        ASSERT_TRUE(widget->isVisible() && widget->isEnabled()) << widget->objectName().toStdString();
        QTest::mouseClick(widget, Qt::LeftButton);
        ASSERT_TRUE(settle());
    }
    void click_tool(const char* name) { click(find<QToolButton>(name)); }
    QPoint place_of(QPoint pixel) {
        auto& view = window.view();
        return (view.transform().view_from_pixel(pixel) / view.devicePixelRatioF()).toPoint();
    }
    void point_at(QPoint pixel) {
        ++count;
        ASSERT_TRUE(QTest::qWaitFor([&] {
            QTest::mouseMove(&window.view(), place_of(pixel) + QPoint(3, 2));
            QTest::mouseMove(&window.view(), place_of(pixel));
            return window.inspector().pointed().x() >= 0;
        }));
    }
    void drag(QPoint from, QPoint to) {
        ++count;
        QTest::mousePress(&window.view(), Qt::LeftButton, {}, place_of(from));
        QTest::mouseMove(&window.view(), place_of((from + to) / 2));
        QTest::mouseMove(&window.view(), place_of(to));
        QTest::mouseRelease(&window.view(), Qt::LeftButton, {}, place_of(to));
        ASSERT_TRUE(settle());
    }
    bool is_seen(const char* dock) { return window.docks().is_seen(dock); }
    int count = 0;
};

TEST_F(TenTasks, FindABufferAmongAll) {
    press("find");
    widgets::FinderDialog* box = nullptr;
    for (auto* each : window.findChildren<widgets::FinderDialog*>())
        if (each->isVisible()) box = each;
    ASSERT_TRUE(box);
    auto* line = box->findChild<QLineEdit*>();
    type(line, "dep buf");
    key(line, Qt::Key_Return);
    EXPECT_EQ(window.views().shown_key(), "depth");
    EXPECT_LE(count, 3);
}

TEST_F(TenTasks, SeeWhereThePictureIsWrong) {
    press("match");
    press("mode-difference");
    EXPECT_EQ(window.views().active_state().mode, ViewMode::difference);
    EXPECT_EQ(window.session().experiment(window.views().active_state().b.owner)->method, "truth");
    EXPECT_LE(count, 2);
}

TEST_F(TenTasks, PutAllMethodsBesideTheTruth) {
    press("set-up-light");
    EXPECT_EQ(window.views().active_state().mode, ViewMode::stages);
    EXPECT_FALSE(window.views().active_state().more.empty());
    EXPECT_LE(count, 1);
}

TEST_F(TenTasks, LookAtWhatStandsInSpace) {
    press("set-up-space");
    EXPECT_EQ(window.workspace().area().open_views().size(), 3u);
    EXPECT_LE(count, 1);
}

TEST_F(TenTasks, ReadAProfileAlongALine) {
    press("line");
    drag({10, 8}, {40, 20});
    EXPECT_TRUE(is_seen("profile"));
    EXPECT_TRUE(
        QTest::qWaitFor([&] { return window.profile().panel().profile().data().series.size() == 1; }, 60000));
    EXPECT_LE(count, 2);
}

TEST_F(TenTasks, LightAPlace) {
    point_at({20, 10});
    press("light-here");
    ASSERT_EQ(window.session().document().lights.size(), 1u);
    EXPECT_EQ(window.session().experiment()->lights, first_lights().id) << "it shines at once";
    EXPECT_LE(count, 2);
}

TEST_F(TenTasks, AskHowAPixelCameAbout) {
    point_at({20, 10});
    press("explain");
    EXPECT_TRUE(window.inspector().explained().has_value());
    EXPECT_LE(count, 2);
}

TEST_F(TenTasks, AskWhichNumbersMatter) {
    bool is_asked = false;
    on_analysis = [&](const engine::AnalysisRequest& request, const engine::AnalysisCallbacks&) {
        is_asked = request.analysis.kind == "sensitivity";
        return engine::AnalysisResult{};
    };
    press("dock-analyses");
    auto* panel = window.findChild<AnalysesDock*>();
    auto* menu = panel->findChild<QToolButton*>("new")->menu();
    count += 2;  // the button, and an entry of its menu
    menu->findChild<QAction*>("new:sensitivity")->trigger();
    ASSERT_TRUE(settle());
    window.docks().raise("analyses");
    click(panel->findChild<QToolButton*>("run"));
    EXPECT_TRUE(QTest::qWaitFor([&] { return is_asked && window.is_settled(); }, 60000));
    EXPECT_LE(count, 4);
}

TEST_F(TenTasks, SweepTwoParametersWithPlotAndReport) {
    save();
    press("dock-sweeps");
    click(find<QPushButton>("empty-button"));
    ASSERT_EQ(window.session().document().sweeps.size(), 1u);
    // For each axis its key, its values and Enter, and a click for the second one: SeriesTest does it by
    // hand.
    count += 7;
    window.session().edit([&](const projects::Project& project) {
        auto changed = sweep();
        changed.axes = {{"level", {4, 2, 1}}, {"seed", {1, 2}}};
        return projects::edits::change(project, changed);
    });
    ASSERT_TRUE(settle());
    click_tool("run");
    ASSERT_TRUE(finish());
    ASSERT_EQ(count_done(), 6);
    ++count;
    find<QTabBar>("tabs")->setCurrentIndex(widgets::SweepPanel::plot_tab);
    ASSERT_TRUE(settle());
    EXPECT_GT(panel().plot().data().count(), 0u);
    EXPECT_TRUE(find<QAction>("report")->isEnabled());
    count += 3;  // the button, an entry of its menu, and Enter in the file dialog
    EXPECT_LE(count, 14);
}

TEST_F(TenTasks, ShareAComparison) {
    save();
    press("match");
    press("comparison-add");
    ASSERT_EQ(window.session().document().comparisons.size(), 1u);
    EXPECT_TRUE(window.action("report")->isEnabled());
    count += 2;  // its keys, and Enter in the file dialog
    window.reports().write_to(folder.filePath("shared.html"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.reports().is_writing(); }, 60000));
    EXPECT_GT(std::filesystem::file_size(folder.filePath("shared.html").toStdString()), 1000u);
    EXPECT_LE(count, 4);
}

}  // namespace
}  // namespace ir::gui
