// Ten everyday tasks, done by mouse and keys, and how many steps each takes (docs/testing.md).
#include <QDockWidget>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTabBar>

#include "app/gui/dialog_folder.h"
#include "tests/gui/window/opened_files.h"
#include "tests/gui/window/sweeps_fixture.h"
#include "tests/gui/window/written_report.h"
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
    void click_tab(QTabBar& tabs, int tab) {
        ++count;
        QTest::mouseClick(&tabs, Qt::LeftButton, {}, tabs.tabRect(tab).center());
        ASSERT_TRUE(settle());
    }
    /// A button and an entry of the menu that it opens.
    void click_entry(QToolButton* button, const char* name) {
        ++count;
        bool is_clicked = false;
        QTimer hand;  // the menu has an event loop of its own
        QObject::connect(&hand, &QTimer::timeout, [&] {
            auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
            if (!menu || std::exchange(is_clicked, true)) return;
            auto* entry = menu->findChild<QAction*>(QLatin1String(name));
            if (!entry || !entry->isEnabled()) {
                ADD_FAILURE() << name;
                return void(menu->close());  // else its loop never ends
            }
            QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(entry).center());
        });
        hand.start(1);
        click(button);
        EXPECT_TRUE(is_clicked) << name;
    }
    /// What is done opens a dialog for a file; Enter takes the one that it proposes.
    template <class Do>
    void enter_file(Do open) {
        remember_export(folder.filePath("any"));
        bool is_entered = false;
        QTimer hand;  // the dialog has an event loop of its own
        QObject::connect(&hand, &QTimer::timeout, [&] {
            auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
            if (!dialog || std::exchange(is_entered, true)) return;
            key(dialog->findChild<QLineEdit*>(), Qt::Key_Return);
        });
        hand.start(1);
        open();
        EXPECT_TRUE(is_entered);
    }
    /// Of pictures of one value each.
    void expect_report(const std::vector<float>& values) {
        ASSERT_TRUE(QTest::qWaitFor([&] { return !window.reports().is_writing(); }, 60000));
        EXPECT_EQ(QFileInfo(opened.file()).suffix(), "html") << "the browser shows it";
        const WrittenReport report(opened.file());
        std::vector<float> shown;
        for (const auto& each : report.pictures()) shown.push_back(each.value);
        EXPECT_EQ(shown, values);
        EXPECT_TRUE(report.text().contains("<h2>Metrics</h2>") || report.text().contains("<h2>Plots</h2>"));
        EXPECT_FALSE(report.text().contains("Missing or stale"));
    }
    /// Of the editor of what is chosen in the project.
    template <class Widget>
    Widget* field(const char* name) {
        for (auto* each : window.document().editor().findChildren<Widget*>(QLatin1String(name)))
            if (each->isVisible()) return each;
        return nullptr;
    }
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
    OpenedFiles opened;
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
    click_entry(panel->findChild<QToolButton*>("new"), "new:sensitivity");
    click(panel->findChild<QToolButton*>("run"));
    EXPECT_TRUE(QTest::qWaitFor([&] { return is_asked && window.is_settled(); }, 60000));
    EXPECT_LE(count, 4);
}

TEST_F(TenTasks, SweepTwoParametersWithPlotAndReport) {
    save();
    press("dock-sweeps");
    click(find<QPushButton>("empty-button"));
    ASSERT_EQ(window.session().document().sweeps.size(), 1u);
    click(field<QToolButton>("axes.add"));
    auto* values = field<QLineEdit>("axis-values");
    ASSERT_TRUE(values && values->hasFocus());
    type(values, "4, 2, 1");
    key(values, Qt::Key_Return);
    click(field<QToolButton>("axes.add"));
    EXPECT_EQ(field<QComboBox>("axis-key")->currentText(), "Items");
    type(values, "1, 2");
    key(values, Qt::Key_Return);
    const std::vector<projects::Sweep::Axis> axes{{"level", {4, 2, 1}}, {"items", {1, 2}}};
    ASSERT_EQ(sweep().axes, axes);
    click_tool("run");
    ASSERT_TRUE(finish());
    ASSERT_EQ(count_done(), 6);
    click_tab(*find<QTabBar>("tabs"), widgets::SweepPanel::plot_tab);
    EXPECT_GT(panel().plot().data().count(), 0u);
    enter_file([&] { click_entry(find<QToolButton>("files"), "report"); });
    expect_report({4, 4, 2, 2, 1, 1, 1});  // the last one is the ground truth
    EXPECT_LE(count, 13);
}

TEST_F(TenTasks, ShareAComparison) {
    save();
    type_level("0.75");
    press("match");
    press("comparison-add");
    ASSERT_EQ(window.session().document().comparisons.size(), 1u);
    enter_file([&] { press("report"); });
    expect_report({0.75f, 0.25f});
    EXPECT_LE(count, 4);
}

}  // namespace
}  // namespace ir::gui
