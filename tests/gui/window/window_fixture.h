#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QTest>

#include "app/gui/main_window.h"
#include "tests/gui/window/fake_renderer.h"
#include "widgets/parameters/number_field.h"

namespace ir::gui {

/// Gives `window` the keyboard, as a window manager does; a bare X server has none. Waits until the server
/// has said so: a dialog that goes takes the keyboard with it, one that comes asks for it, and both may be
/// heard later.
inline bool activate(QWidget& window) {
    return QTest::qWaitFor([&] {
        if (QGuiApplication::focusWindow() == window.windowHandle() &&
            QApplication::activeWindow() == &window)
            return true;
        window.activateWindow();
        return false;
    });
}

/// A real window on a renderer that answers at once with what it was asked for.
class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
        ASSERT_TRUE(activate(window));
    }
    void TearDown() override {
        // The window would ask whether to save.
        if (window.session().has_project()) window.session().files().close();
    }
    void open_scene() {
        ASSERT_TRUE(window.open_path("builtin:cornell"));
        ASSERT_TRUE(QTest::qWaitFor([this] { return state() == LivePictures::State::done; }, 60000));
    }
    LivePictures::State state() {
        const auto* chosen = window.session().experiment();
        return chosen ? window.live().state(chosen->id) : LivePictures::State::absent;
    }
    bool settle() {
        QApplication::processEvents();
        return QTest::qWaitFor([this] { return window.is_settled(); }, 60000);
    }
    widgets::NumberField* level() {
        return window.findChild<QWidget*>("editor:level")->findChild<widgets::NumberField*>();
    }
    void type_level(const char* text) {
        level()->setFocus();
        level()->selectAll();
        QTest::keyClicks(level(), text);
        QTest::keyClick(level(), Qt::Key_Return);
        ASSERT_TRUE(settle());
    }
    /// Chooses an entry of a combo box as a person does.
    void choose(QComboBox* combo, const QString& text) {
        const int index = combo->findText(text);
        ASSERT_GE(index, 0) << text.toStdString();
        combo->setFocus();
        combo->setCurrentIndex(index);
        emit combo->activated(index);
        ASSERT_TRUE(settle());
    }
    QComboBox* header(const char* name) {
        return window.workspace().active_pane().header().findChild<QComboBox*>(name);
    }
    void trigger(const char* action) {
        ASSERT_TRUE(window.action(action)->isEnabled()) << action;
        window.action(action)->trigger();
        ASSERT_TRUE(settle());
    }
    /// The second experiment gets another scene.
    void make_scenes_differ() {
        window.session().files().add_scene("builtin:plane");
        const auto second = window.session().document().experiments[1].id;
        const auto scene = window.session().document().scenes[1].id;
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_scene_of(project, second, scene);
        });
        ASSERT_TRUE(settle());
    }
    /// A second experiment with another value, and the first one chosen again.
    void add_second_experiment(double value) {
        const auto first = window.session().experiment()->id;
        trigger("experiment-duplicate");
        const auto second = window.session().experiment()->id;
        ASSERT_NE(first, second);
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_values(project, fake_registry(), second, {{"level", value}});
        });
        ASSERT_TRUE(settle());
        window.session().select_experiment(first);
        ASSERT_TRUE(settle());
    }
    /// What undo would take back, in steps.
    std::size_t steps() { return window.session().open_project().undo_stack().position(); }
    const projects::LightSet& first_lights() { return window.session().document().lights.at(0); }
    float pixel() { return window.view().image().at(0, 0); }
    std::string label(const char* name) { return window.findChild<QLabel*>(name)->text().toStdString(); }

    FakeRenderer renderer;
    /// What the study's thread does.
    engine::StudyRunner on_study = [](const engine::StudyRequest&, const engine::StudyCallbacks&) {
        return engine::ErrorStudy{};
    };
    /// What the sweep's thread does.
    engine::SweepRunner on_sweep = [](const engine::SweepRequest&, const engine::SweepCallbacks&) {};
    /// What the analysis' thread does.
    engine::AnalysisRunner on_analysis = [](const engine::AnalysisRequest&,
                                            const engine::AnalysisCallbacks&) {
        return engine::AnalysisResult{};
    };
    MainWindow window{
        renderer,
        fake_registry(),
        {.remember = false,
         .surface = painted,
         .study_runner = [this](const auto& request,
                                const auto& callbacks) { return on_study(request, callbacks); },
         .sweep_runner = [this](const auto& request, const auto& callbacks) { on_sweep(request, callbacks); },
         .analysis_runner = [this](const auto& request,
                                   const auto& callbacks) { return on_analysis(request, callbacks); }}};
};

}  // namespace ir::gui
