// Pictures of every panel, dialog, menu, layout and kind of view, of one project in which all of them have
// something to show, for a person to look at: ./dev screenshots. A panel, menu or dialog that is new comes in
// by itself. Words that do not fit where they stand fail the test.
#include <gtest/gtest.h>
#include <sys/types.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <QTreeView>
#include <cmath>
#include <set>

#include "app/engine/execution.h"
#include "app/gui/main_window.h"
#include "tests/gui/events.h"
#include "tests/small_sample.h"

/// Renderers give way to everything else, and would wait for whatever the machine does beside. Nobody works
/// in this window. The linker puts it in the place of the system's.
extern "C" int __wrap_setpriority(int, id_t, int) {
    return 0;
}

namespace ir::gui {
namespace {

constexpr int patience_ms = 400'000;  // of a sweep while others work
constexpr glm::ivec2 picture_size{240, 180};
constexpr QSize large_screen(3840, 2160);  // in its own pixels

/// "&Keep this layout …" → "keep-this-layout"
QString file_name(QString text) {
    text = text.toLower().remove(QLatin1Char('&'));
    static const QRegularExpression others(QStringLiteral("[^a-z0-9]+"));
    text.replace(others, QStringLiteral("-"));
    while (text.endsWith(QLatin1Char('-'))) text.chop(1);
    return text;
}

bool promises_a_dialog(const QAction& action) {
    return action.text().endsWith(QChar(0x2026));
}

/// What is photographed. All tests of a suite have the same one, so that nothing is rendered twice.
struct Subject {
    QTemporaryDir folder;
    std::unique_ptr<Renderer> renderer = make_thread_renderer({.backend = {}, .device = {}, .debug = true});
    MainWindow window{*renderer, engine::registry(), {.remember = false}};
    std::set<QString> taken;
    enum { empty, being_filled, filled } state = empty;
};
std::unique_ptr<Subject> subject;

class Screens : public testing::TestWithParam<const char*> {
  protected:
    static void SetUpTestSuite() {
        subject = std::make_unique<Subject>();
        subject->window.resize(min_size_for_all_panels);
        subject->window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&subject->window));
    }
    static void TearDownTestSuite() {
        if (subject->window.session().has_project()) subject->window.session().files().close();
        subject.reset();
    }
    Screens() {
        const auto wanted = qEnvironmentVariable("INTERREFLECT_SCREENSHOTS");
        pictures_ = wanted.isEmpty() ? subject->folder.path() : wanted;
        QDir().mkpath(pictures_);
        const bool is_light = GetParam() == std::string("light");
        widgets::apply_theme(*qApp, is_light ? widgets::Theme::light : widgets::Theme::dark);
    }
    void SetUp() override { ASSERT_TRUE(settle()); }

    bool settle() {
        test::handle_events();
        return QTest::qWaitFor([this] { return window.is_settled(); }, patience_ms);
    }
    void trigger(const char* name) {
        ASSERT_TRUE(window.action(name)->isEnabled()) << name;
        window.action(name)->trigger();
        ASSERT_TRUE(settle()) << name;
    }
    QDockWidget& dock(const QString& name) { return *window.findChild<QDockWidget*>(name); }
    QList<QDockWidget*> docks() {
        return window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    }
    void click(const char* dock_name, const char* button_name) {
        window.docks().raise(QLatin1String(dock_name));
        ASSERT_TRUE(settle());
        auto* button = dock(QLatin1String(dock_name)).findChild<QAbstractButton*>(QLatin1String(button_name));
        ASSERT_TRUE(button && button->isEnabled()) << dock_name << ": " << button_name;
        button->click();
        ASSERT_TRUE(settle()) << dock_name;
    }
    void choose(const char* dock_name, const char* list_name, const char* id) {
        auto* list = dock(QLatin1String(dock_name)).findChild<QComboBox*>(QLatin1String(list_name));
        ASSERT_GE(list->findData(id), 0) << dock_name << ": " << id;
        list->setCurrentIndex(list->findData(id));
        emit list->activated(list->currentIndex());
        ASSERT_TRUE(settle());
    }
    void choose_experiment(const std::string& id) {
        window.session().select_experiment(id);
        ASSERT_TRUE(settle());
    }
    std::string still() { return window.session().document().experiments.at(0).id; }
    std::string moving() { return window.session().document().experiments.at(1).id; }
    std::string reference() { return window.session().document().experiments.at(2).id; }

    void take(QWidget& shown, const QString& name) {
        test::handle_events();
        const QString scale = QString::number(std::lround(shown.devicePixelRatioF()));
        const auto file = QStringLiteral("%1-%2-%3x.png").arg(name, QLatin1String(GetParam()), scale);
        EXPECT_TRUE(subject->taken.insert(file).second) << file.toStdString() << " is there twice";
        EXPECT_TRUE(shown.grab().save(pictures_ + QLatin1Char('/') + file)) << file.toStdString();
        expect_words_fit(shown, name.toStdString());
    }
    void expect_words_fit(const QWidget& shown, const std::string& name) {
        const auto is_seen = [&](const QWidget& each) {
            return each.isVisibleTo(&shown) && !each.visibleRegion().isEmpty();
        };
        for (const auto* each : shown.findChildren<QLabel*>()) {
            const auto text = each->text();
            const bool may_be_cut = each->sizePolicy().horizontalPolicy() == QSizePolicy::Ignored &&
                                    !each->toolTip().isEmpty();  // which has all of it
            if (text.isEmpty() || text.contains(QChar(0x2026)) || may_be_cut || !is_seen(*each)) continue;
            const bool fits = each->wordWrap() ? each->heightForWidth(each->width()) <= each->height() + 1
                                               : each->sizeHint().width() <= each->width() + 1;
            EXPECT_TRUE(fits) << name << ", " << each->objectName().toStdString() << ": "
                              << text.toStdString();
        }
        const auto ground = QApplication::palette().color(QPalette::Base).lightness();
        for (const auto* each : shown.findChildren<QAbstractItemView*>())
            if (is_seen(*each)) {
                EXPECT_NEAR(each->palette().color(QPalette::Base).lightness(), ground, 40)
                    << name << ", " << each->objectName().toStdString() << " has another theme";
            }
        for (const auto* each : shown.findChildren<QAbstractButton*>())
            if (!each->text().isEmpty() && is_seen(*each)) {
                // Styles ask for more than a sign such as ± takes; cards wrap theirs.
                const auto words = each->fontMetrics().size(Qt::TextShowMnemonic, each->text());
                const int room = each->minimumSizeHint().width();
                const int needed = each->icon().isNull() ? std::min(room, words.width() + 2) : room;
                EXPECT_LE(needed, each->width() + 1)
                    << name << ", " << each->objectName().toStdString() << ": " << each->text().toStdString();
            }
    }
    void take_menu(QMenu& menu, const QString& name) {
        emit menu.aboutToShow();
        if (menu.actions().isEmpty()) return;
        menu.popup(window.pos());
        take(menu, QStringLiteral("menu-") + name);
        menu.hide();
    }
    QWidget* other_window() {
        for (auto* each : QApplication::topLevelWidgets())
            if (each->isVisible() && each != &window &&
                (each->windowType() == Qt::Dialog || each->windowType() == Qt::Window))
                return each;
        return nullptr;
    }
    void take_dialog(QAction& action, const QString& name) {
        EXPECT_TRUE(action.isEnabled()) << name.toStdString() << ": " << action.toolTip().toStdString();
        bool is_taken = false;
        QTimer looks;
        QObject::connect(&looks, &QTimer::timeout, [&] {
            auto* dialog = other_window();
            if (!dialog || !window.is_settled() || std::exchange(is_taken, true)) return;
            take(*dialog, QStringLiteral("dialog-") + name);
            dialog->close();
        });
        looks.start(20);
        action.trigger();
        EXPECT_TRUE(QTest::qWaitFor([&] { return is_taken && !other_window(); }, patience_ms))
            << name.toStdString();
    }

    QString pictures_;
    MainWindow& window = subject->window;
};

/// A project that has some of everything that a panel can show.
class FilledScreens : public Screens {
  protected:
    void SetUp() override {
        if (subject->state == Subject::empty) {
            subject->state = Subject::being_filled;
            fill();
            if (HasFatalFailure()) return;
            subject->state = Subject::filled;
        }
        ASSERT_EQ(subject->state, Subject::filled) << "the project could not be made";
        window.docks().restore_default();
        trigger("views-1");
        trigger("mode-single");
        choose_experiment(still());
    }

    void fill() {
        ASSERT_TRUE(window.open_path(QString::fromStdString(sample().string())));
        ASSERT_TRUE(settle());
        trigger("light-camera");
        trigger("bookmark");
        choose_experiment(moving());
        trigger("camera-key-add");
        look_from(moving(), {0, 0.5, 0});
        trigger("camera-key-add");
        window.playback().return_to_own_time();
        choose_experiment(still());
        trigger("keep");
        for (const std::int64_t texels : {80, 60}) {
            window.session().edit([&](const projects::Project& project) {
                return projects::edits::set_values(project, window.session().registry(), still(),
                                                   {{"resolution", texels}});
            });
            window.session().end_gesture();
            ASSERT_TRUE(settle());
        }
        window.workspace().tools().set_line({picture_size.x, picture_size.y}, {20, 90, 220, 100});
        window.workspace().tools().set_region({picture_size.x, picture_size.y}, {60, 40, 90, 80});
        window.inspector().pin({120, 130});
        window.inspector().pin({40, 60});
        click("sweeps", "run");
        click("plots", "plot-run");
        window.docks().raise("analyses");
        auto* kinds = dock("analyses").findChild<QToolButton*>("new")->menu();
        kinds->findChild<QAction*>("new:disagreement")->trigger();
        ASSERT_TRUE(settle());
        click("analyses", "run");
        window.docks().raise("benchmarks");
        choose("benchmarks", "benchmark", "hbao");
        choose("benchmarks", "place", "experiment");
        window.benchmarks().panel().findChild<QSpinBox*>("repeats")->setValue(1);
        click("benchmarks", "run");
    }
    /// With few variations and points: they are rendered.
    std::filesystem::path sample() {
        const auto folder =
            test::small_sample("atrium-error", subject->folder.path().toStdString(), picture_size);
        auto project = nlohmann::ordered_json::parse(std::ifstream(folder / "project.json"));
        project["sweeps"][0]["axes"] = {{{"key", "directions"}, {"values", {16, 32}}},
                                        {{"key", "resolution"}, {"values", {40, 80}}}};
        project["plots"][0]["values"] = {16, 32};
        std::ofstream(folder / "project.json") << project.dump(2);
        return folder;
    }
    void look_from(const std::string& experiment, const glm::dvec3& step) {
        auto pose = *window.session().camera().pose();
        pose.eye += step;
        window.session().camera().move(experiment, pose);
        window.session().camera().finish_move();
        ASSERT_TRUE(settle());
    }
    void compare_with_reference() {
        window.views().compare_with(reference());
        ASSERT_TRUE(settle());
    }
    void take_tabs(const char* dock_name) {
        auto* tabs = dock(QLatin1String(dock_name)).findChild<QTabBar*>();
        for (int tab = 1; tab < tabs->count(); ++tab) {
            tabs->setCurrentIndex(tab);
            ASSERT_TRUE(settle());
            take(dock(QLatin1String(dock_name)),
                 QStringLiteral("panel-%1-%2").arg(QLatin1String(dock_name), file_name(tabs->tabText(tab))));
        }
        tabs->setCurrentIndex(0);
    }
};

TEST_P(Screens, Start) {
    ASSERT_TRUE(window.isVisible());
    take(window, "window-start");
    for (auto* menu : window.menuBar()->findChildren<QMenu*>(QString(), Qt::FindDirectChildrenOnly))
        if (!menu->title().isEmpty()) take_menu(*menu, "start-" + file_name(menu->title()));
}

TEST_P(FilledScreens, Layouts) {
    take(window, "window-default");
    for (const auto& [name, title, doc] : DockLayout::entries()) {
        window.docks().apply(name);
        ASSERT_TRUE(settle());
        take(window, "window-" + name);
    }
}

TEST_P(FilledScreens, Panels) {
    const std::vector<ShaderFault> faults{
        {"methods/ldm-ao/gather.comp", 31, "`occlusion' undeclared", "result += occlusion;", "/gather.comp"},
        {"lib/light.glsl", 0, "unexpected end of file"}};
    for (const auto* each : docks()) {
        const auto name = each->objectName();
        if (name == "timeline") choose_experiment(moving());
        if (name == "shaders") emit subject->renderer->shader_faults_changed(faults);
        const bool has_layout = DockLayout::names().contains(name);
        has_layout ? window.docks().apply(name) : window.docks().restore_default();
        window.docks().raise(name);
        ASSERT_TRUE(settle());
        take(dock(name), "panel-" + name);
        if (name == "sweeps") take_tabs("sweeps");
        if (name == "timeline") choose_experiment(still());
    }
    emit subject->renderer->shader_faults_changed({});
}

TEST_P(FilledScreens, MetricsOfTwo) {
    trigger("mode-side-by-side");
    compare_with_reference();
    window.docks().raise("metrics");
    ASSERT_TRUE(settle());
    take(dock("metrics"), "panel-metrics-compared");
}

/// The editor of the first item of each kind.
TEST_P(FilledScreens, Items) {
    window.docks().apply("project");
    auto* tree = window.document().tree().findChild<QTreeView*>();
    const auto& items = *tree->model();
    for (int row = 0; row < items.rowCount(); ++row) {
        const auto group = items.index(row, 0);
        if (items.rowCount(group) == 0) continue;
        const auto item = items.index(0, 0, group);
        if (!(items.flags(item) & Qt::ItemIsEnabled)) continue;
        tree->setCurrentIndex(item);
        ASSERT_TRUE(settle());
        take(dock("project"), "item-" + file_name(group.data().toString()));
    }
}

TEST_P(FilledScreens, Views) {
    window.docks().apply("picture");
    for (const auto mode : widgets::all_modes()) {
        window.views().set_mode(mode);
        if (widgets::compares(mode) && !widgets::takes_many(mode)) compare_with_reference();
        ASSERT_TRUE(settle());
        take(window, "view-" + QString::fromStdString(widgets::to_key(mode)));
    }
    window.views().set_mode(widgets::ViewMode::single);
    trigger("views-4");
    take(window, "view-four");
}

TEST_P(FilledScreens, Menus) {
    ASSERT_TRUE(window.isVisible());
    for (auto* menu : window.menuBar()->findChildren<QMenu*>())
        if (!menu->title().isEmpty()) take_menu(*menu, file_name(menu->title()));
}

/// What the buttons of panels open, and the dialogs behind that.
TEST_P(FilledScreens, MenusOfPanels) {
    for (auto* each : docks()) {
        window.docks().raise(each->objectName());
        ASSERT_TRUE(settle());
        for (auto* button : each->findChildren<QToolButton*>()) {
            if (!button->menu() || !button->isVisible()) continue;
            const auto name = each->objectName() + QLatin1Char('-') + button->objectName();
            take_menu(*button->menu(), name);
            for (auto* action : button->menu()->actions())
                if (promises_a_dialog(*action))
                    take_dialog(*action, name + QLatin1Char('-') + action->objectName());
        }
    }
}

/// Each action whose name ends in three dots promises one.
TEST_P(FilledScreens, Dialogs) {
    ASSERT_TRUE(window.isVisible());
    for (auto* action : window.actions())
        if (promises_a_dialog(*action) || action->objectName() == "manual" || action->objectName() == "about")
            take_dialog(*action, action->objectName());
}

TEST_P(FilledScreens, WindowOnALargeScreen) {
    window.resize(large_screen / window.devicePixelRatioF());
    ASSERT_TRUE(settle());
    take(window, "large-default");
    for (const char* layout : {"compare", "sweeps", "maps"}) {
        window.docks().apply(layout);
        ASSERT_TRUE(settle());
        take(window, QStringLiteral("large-") + QLatin1String(layout));
    }
    window.resize(min_size_for_all_panels);
}

TEST_P(FilledScreens, Explained) {
    window.inspector().explain({120, 130});
    ASSERT_TRUE(settle());
    take(window, "window-explained");
}

TEST_P(FilledScreens, SetUpSpace) {
    ASSERT_TRUE(window.isVisible());
    trigger("set-up-space");
    take(window, "window-set-up-space");
}

INSTANTIATE_TEST_SUITE_P(, Screens, testing::Values("dark", "light"),
                         [](const auto& each) { return std::string(each.param); });
INSTANTIATE_TEST_SUITE_P(, FilledScreens, testing::Values("dark", "light"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace ir::gui
