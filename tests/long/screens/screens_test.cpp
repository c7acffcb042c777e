// Pictures of every panel, dialog, menu, layout and kind of view, of one project in which all of them have
// something to show, for a person to look at: ./dev screenshots. A panel or a dialog that is new comes in by
// itself. Words that do not fit where they stand fail the test.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
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

namespace ir::gui {
namespace {

constexpr int patience_ms = 400'000;  // of a sweep while others work
constexpr glm::ivec2 picture_size{240, 180};

/// "&Keep this layout …" → "keep-this-layout"
QString file_name(QString text) {
    text = text.toLower().remove(QLatin1Char('&'));
    static const QRegularExpression others(QStringLiteral("[^a-z0-9]+"));
    text.replace(others, QStringLiteral("-"));
    while (text.endsWith(QLatin1Char('-'))) text.chop(1);
    return text;
}

class Screens : public testing::TestWithParam<const char*> {
  protected:
    Screens() {
        const auto wanted = qEnvironmentVariable("INTERREFLECT_SCREENSHOTS");
        folder_ = wanted.isEmpty() ? temporary_.path() : wanted;
        QDir().mkpath(folder_);
        window.resize(min_size_for_all_panels);
        window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    }
    ~Screens() override {
        if (window.session().has_project()) window.session().files().close();
    }

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
    void click(const char* dock_name, const char* button_name) {
        window.docks().raise(QLatin1String(dock_name));
        ASSERT_TRUE(settle());
        auto* button = dock(QLatin1String(dock_name)).findChild<QAbstractButton*>(QLatin1String(button_name));
        ASSERT_TRUE(button && button->isEnabled()) << dock_name << ": " << button_name;
        button->click();
        ASSERT_TRUE(settle()) << dock_name;
    }

    void take(QWidget& shown, const QString& name) {
        test::handle_events();
        const QString scale = QString::number(std::lround(shown.devicePixelRatioF()));
        const auto file =
            QStringLiteral("%1/%2-%3-%4x.png").arg(folder_, name, QLatin1String(GetParam()), scale);
        EXPECT_TRUE(taken_.insert(name).second) << name.toStdString() << " is there twice";
        EXPECT_TRUE(shown.grab().save(file)) << file.toStdString();
        expect_words_fit(shown, name.toStdString());
    }
    void expect_words_fit(const QWidget& shown, const std::string& name) {
        const auto is_seen = [&](const QWidget& each) {
            return each.isVisibleTo(&shown) && !each.visibleRegion().isEmpty();
        };
        for (const auto* each : shown.findChildren<QLabel*>()) {
            const auto text = each->text();
            if (text.isEmpty() || text.contains(QChar(0x2026)) || !is_seen(*each)) continue;
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
                EXPECT_LE(each->minimumSizeHint().width(), each->width() + 1)
                    << name << ", " << each->objectName().toStdString() << ": " << each->text().toStdString();
            }
    }

    /// Some of everything that a panel can show.
    void fill() {
        ASSERT_TRUE(window.open_path(QString::fromStdString(sample().string())));
        ASSERT_TRUE(settle());
        const auto first = window.session().experiment()->id;
        const auto second = window.session().document().experiments.at(1).id;
        trigger("light-camera");
        trigger("bookmark");
        window.session().select_experiment(second);
        ASSERT_TRUE(settle());
        trigger("camera-key-add");
        look_from(second, {0, 0.5, 0});
        trigger("camera-key-add");
        window.playback().return_to_own_time();
        window.session().select_experiment(first);
        ASSERT_TRUE(settle());
        trigger("keep");
        for (const std::int64_t texels : {80, 60}) {
            window.session().edit([&](const projects::Project& project) {
                return projects::edits::set_values(project, window.session().registry(), first,
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
    }
    /// With few variations and points: they are rendered.
    std::filesystem::path sample() {
        const auto folder = test::small_sample("atrium-error", temporary_.path().toStdString(), picture_size);
        auto project = nlohmann::ordered_json::parse(std::ifstream(folder / "project.json"));
        project["sweeps"][0]["axes"][0]["values"] = project["plots"][0]["values"] = {32, 64};
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

    void take_layouts() {
        for (const auto& [name, title] : DockLayout::titles()) {
            window.docks().apply(name);
            ASSERT_TRUE(settle());
            take(window, "window-" + name);
        }
    }
    void take_panels() {
        for (const auto* each : window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
            const auto name = each->objectName();
            if (name == "timeline") window.session().select_experiment(moving());
            if (name == "shaders") emit renderer->shader_faults_changed(faults);
            window.docks().apply(DockLayout::names().contains(name) ? name : QStringLiteral("default"));
            window.docks().raise(name);
            ASSERT_TRUE(settle());
            take(dock(name), "panel-" + name);
            if (name == "metrics") take_metrics();
            if (name == "timeline")
                window.session().select_experiment(window.session().document().experiments.front().id);
        }
    }
    std::string moving() { return window.session().document().experiments.at(1).id; }
    void take_metrics() {
        trigger("mode-side-by-side");
        window.views().compare_with(window.session().document().experiments.back().id);
        ASSERT_TRUE(settle());
        take(dock("metrics"), "panel-metrics-compared");
        trigger("mode-single");
    }
    /// The editor of the first item of each kind.
    void take_items() {
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
    void take_modes() {
        window.docks().apply("picture");
        for (const auto mode : widgets::all_modes()) {
            window.views().set_mode(mode);
            if (widgets::compares(mode) && !widgets::takes_many(mode))
                window.views().compare_with(window.session().document().experiments.back().id);
            ASSERT_TRUE(settle());
            take(window, "view-" + QString::fromStdString(widgets::to_key(mode)));
        }
        window.views().set_mode(widgets::ViewMode::single);
        trigger("views-4");
        take(window, "view-four");
        trigger("views-1");
    }
    void take_menus() {
        for (auto* menu : window.menuBar()->findChildren<QMenu*>()) {
            emit menu->aboutToShow();
            if (menu->actions().isEmpty() || menu->title().isEmpty()) continue;
            menu->popup(window.pos());
            take(*menu, "menu-" + file_name(menu->title()));
            menu->hide();
        }
    }
    /// Each action whose name ends in three dots promises one.
    void take_dialogs() {
        for (auto* action : window.actions())
            if (action->text().endsWith(QChar(0x2026)) || action->objectName() == "manual" ||
                action->objectName() == "about")
                take_dialog(*action);
    }
    QWidget* other_window() {
        for (auto* each : QApplication::topLevelWidgets())
            if (each->isVisible() && each != &window &&
                (each->windowType() == Qt::Dialog || each->windowType() == Qt::Window))
                return each;
        return nullptr;
    }
    void take_dialog(QAction& action) {
        const auto name = "dialog-" + action.objectName();
        EXPECT_TRUE(action.isEnabled()) << name.toStdString() << ": " << action.toolTip().toStdString();
        bool is_taken = false;
        QTimer looks;
        QObject::connect(&looks, &QTimer::timeout, [&] {
            auto* dialog = other_window();
            if (!dialog || !window.is_settled() || std::exchange(is_taken, true)) return;
            take(*dialog, name);
            dialog->close();
        });
        looks.start(20);
        action.trigger();
        EXPECT_TRUE(QTest::qWaitFor([&] { return is_taken && !other_window(); }, 20'000))
            << name.toStdString();
    }

    const std::vector<ShaderFault> faults{
        {"methods/ldm-ao/gather.comp", 31, "`occlusion' undeclared", "result += occlusion;", "/gather.comp"},
        {"lib/light.glsl", 0, "unexpected end of file"}};
    QTemporaryDir temporary_;
    QString folder_;
    std::set<QString> taken_;
    std::unique_ptr<Renderer> renderer = make_thread_renderer({.backend = {}, .device = {}, .debug = true});
    MainWindow window{*renderer, engine::registry(), {.remember = false, .theme = GetParam()}};
};

TEST_P(Screens, OfAllThatAPersonSees) {
    ASSERT_TRUE(settle());
    take(window, "window-start");
    fill();
    ASSERT_FALSE(HasFatalFailure());
    window.docks().apply("default");
    ASSERT_TRUE(settle());
    take(window, "window-default");
    take_layouts();
    take_panels();
    take_items();
    take_modes();
    take_menus();
    take_dialogs();
    window.inspector().explain({120, 130});
    ASSERT_TRUE(settle());
    take(window, "window-explained");
    trigger("set-up-space");
    take(window, "window-set-up-space");
}

INSTANTIATE_TEST_SUITE_P(, Screens, testing::Values("dark", "light"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace ir::gui
