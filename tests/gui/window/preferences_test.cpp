#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QMenuBar>
#include <QPushButton>
#include <QSettings>
#include <QToolButton>

#include "tests/gui/window/window_fixture.h"
#include "widgets/compare/difference_worker.h"
#include "widgets/panels/preferences_dialog.h"
#include "widgets/style/theme.h"

namespace ir::gui {
namespace {

using Body = engine::MachineSettings::Body;

/// Windows that remember, one after the other, as runs of the program do.
class PreferencesWindowTest : public testing::Test {
  protected:
    void SetUp() override { QSettings().clear(); }
    void TearDown() override {
        close();
        QSettings().clear();
        widgets::apply_theme(*qApp, widgets::Theme::dark);
        widgets::apply_font_size(*qApp, 0);
        widgets::prefer_maps({});
    }
    void start(const engine::MachineFlags& flags = {}) {
        close();
        renderer = std::make_unique<FakeRenderer>();
        window = std::make_unique<MainWindow>(
            *renderer, fake_registry(),
            MainWindow::Options{.remember = true, .surface = painted, .machine = flags});
        window->show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(window.get()));
        ASSERT_TRUE(activate(*window));
    }
    void close() {
        if (window && window->session().has_project()) window->session().files().close();
        window.reset();
        renderer.reset();
    }
    void open_scene() {
        ASSERT_TRUE(window->open_path("builtin:cornell"));
        ASSERT_TRUE(QTest::qWaitFor([this] { return window->is_settled(); }, 60000));
    }
    void open_by_key() {
        QTest::keyClick(window.get(), Qt::Key_Comma, Qt::ControlModifier);
        ASSERT_TRUE(dialog());
        ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog()));
    }
    widgets::PreferencesDialog* dialog() { return window->findChild<widgets::PreferencesDialog*>(); }
    QWidget* editor(const char* key) {
        return dialog()->findChild<QWidget*>(QStringLiteral("editor:%1").arg(QLatin1String(key)));
    }
    QComboBox* list(const char* key) { return editor(key)->findChild<QComboBox*>(); }
    QComboBox* processor() { return list("processor"); }
    /// With the keyboard, from the first entry down.
    void choose(const char* key, const char* text) {
        auto* entries = list(key);
        entries->setFocus();
        QTest::keyClick(entries, Qt::Key_Home);
        while (entries->currentText() != text && entries->currentIndex() + 1 < entries->count())
            QTest::keyClick(entries, Qt::Key_Down);
        ASSERT_EQ(entries->currentText(), text);
    }
    void click(const char* button) {
        for (auto* each : dialog()->findChildren<QAbstractButton*>())
            if (each->text() == button) return QTest::mouseClick(each, Qt::LeftButton);
        FAIL() << button;
    }
    std::string shown_map() { return window->workspace().display().colour_map; }
    /// With the keyboard, as a person walks through a list.
    void choose_next_processor() {
        processor()->setFocus();
        QTest::keyClick(processor(), Qt::Key_Down);
    }
    void type(const char* key, const char* text) {
        auto* field = editor(key)->findChild<widgets::NumberField*>();
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
        QTest::keyClick(field, Qt::Key_Return);
    }
    std::unique_ptr<FakeRenderer> renderer;
    std::unique_ptr<MainWindow> window;
};

TEST_F(PreferencesWindowTest, OpensOnceWithItsKeyAndClosesWithEscape) {
    start();
    EXPECT_EQ(window->action("preferences")->menuRole(), QAction::PreferencesRole);
    open_by_key();
    window->action("preferences")->trigger();
    EXPECT_EQ(window->findChildren<widgets::PreferencesDialog*>().size(), 1);
    for (auto* each : dialog()->findChildren<widgets::ParameterEditor*>())
        EXPECT_TRUE(each->toolTip().contains("Default: ")) << each->objectName().toStdString();
    for (const auto& each : Preferences::descriptions())
        EXPECT_EQ(editor(each.key.c_str())->focusProxy()->accessibleName().toStdString(), each.label);
    EXPECT_TRUE(dialog()->findChild<QDialogButtonBox*>()->buttons().front()->icon().isNull())
        << "a black picture on dark grey";
    QTest::keyClick(dialog(), Qt::Key_Escape);
    EXPECT_TRUE(QTest::qWaitFor([this] { return !dialog(); }, 60000));
}

TEST_F(PreferencesWindowTest, AFontSizeCountsAtOnceAndIsKept) {
    start();
    const int desktop = QApplication::font().pointSize();
    open_by_key();
    type("font_size", "15");
    EXPECT_EQ(QApplication::font().pointSize(), 15);
    EXPECT_TRUE(QTest::qWaitFor([this] { return window->menuBar()->font().pointSize() == 15; }, 60000));
    for (const char* size : {"1", "5", "3"}) {
        type("font_size", size);
        EXPECT_EQ(QApplication::font().pointSize(), 6) << "what can be read";
        EXPECT_EQ(editor("font_size")->findChild<widgets::NumberField*>()->value(), 6) << "what is used";
        type("font_size", "15");
    }
    type("font_size", "6");
    auto* field = editor("font_size")->findChild<widgets::NumberField*>();
    QTest::keyClick(field, Qt::Key_Down);
    EXPECT_EQ(field->value(), 0) << "one step below is the desktop's";
    QTest::keyClick(field, Qt::Key_Up);
    EXPECT_EQ(field->value(), 6);
    type("font_size", "15");
    start();
    EXPECT_EQ(QApplication::font().pointSize(), 15);
    open_by_key();
    type("font_size", "0");
    EXPECT_EQ(editor("font_size")->findChild<widgets::NumberField*>()->text(), "the desktop's");
    EXPECT_EQ(editor("memory")->findChild<widgets::NumberField*>()->text(), "none");
    EXPECT_EQ(QApplication::font().pointSize(), desktop);
}

TEST_F(PreferencesWindowTest, AThemeCountsAtOnceAndIsKept) {
    const auto lightness = [] { return QApplication::palette().color(QPalette::Window).lightness(); };
    start();
    EXPECT_LT(lightness(), 100);
    open_by_key();
    auto* list = editor("theme")->findChild<QComboBox*>();
    list->setFocus();
    QTest::keyClick(list, Qt::Key_Down);
    EXPECT_GT(lightness(), 200);
    EXPECT_TRUE(QTest::qWaitFor([this] {
        return window->grab().toImage().pixelColor(3, window->height() - 3).lightness() > 200;
    })) << "the window that is open";
    start();
    EXPECT_GT(lightness(), 200) << "in the next run";
    open_by_key();
    editor("theme")->findChild<QComboBox*>()->setFocus();
    QTest::keyClick(editor("theme")->findChild<QComboBox*>(), Qt::Key_Up);
    EXPECT_LT(lightness(), 100);
}

TEST_F(PreferencesWindowTest, ColourMapsOfAllKindsCountAtOnceAndAreKept) {
    start();
    open_scene();
    const auto show = [this](const char* buffer) {
        auto state = window->views().active_state();
        state.a.output = buffer;
        window->views().set_active_state(state);
        return QTest::qWaitFor([this] { return window->is_settled(); }, 60000);
    };
    ASSERT_TRUE(show("depth"));
    EXPECT_EQ(shown_map(), "viridis");
    open_by_key();
    EXPECT_FALSE(list("map_depths")->itemIcon(0).isNull()) << "maps have pictures";
    const auto requests = renderer->requests.size();
    choose("map_depths", "magma");
    EXPECT_EQ(shown_map(), "magma") << "of the picture that is shown";
    choose("map_errors", "turbo");
    choose("map_signed", "viridis");
    choose("map_numbers", "coolwarm");
    EXPECT_EQ(renderer->requests.size(), requests) << "nothing is rendered for it";
    EXPECT_EQ(widgets::map_for_difference(DifferenceKind::flip), "turbo");
    EXPECT_EQ(widgets::map_for_difference(DifferenceKind::significant), "viridis");
    EXPECT_EQ(widgets::preferred_map(Semantic::accessibility, ""), "coolwarm");
    EXPECT_EQ(widgets::preferred_map(Semantic::depth, "turbo"), "turbo") << "what a method says stays";

    start();
    open_scene();
    ASSERT_TRUE(show("depth"));
    EXPECT_EQ(shown_map(), "magma") << "in the next run";
    open_by_key();
    click("&Defaults");
    EXPECT_EQ(shown_map(), "viridis");
    for (const auto& each : Preferences::descriptions())
        EXPECT_FALSE(QSettings().contains("preferences/" + QString::fromStdString(each.key))) << each.key;
    EXPECT_EQ(widgets::map_for_difference(DifferenceKind::flip), "magma");
}

TEST_F(PreferencesWindowTest, AnotherProcessorMakesShownPicturesAnewAndIsKept) {
    start();
    open_scene();
    EXPECT_EQ(renderer->machine.processor, Body::automatic);
    const bool was_dirty = window->session().open_project().is_dirty();
    open_by_key();
    const auto before = renderer->requests.size();
    choose_next_processor();
    EXPECT_EQ(renderer->machine.processor, Body::gl);
    EXPECT_EQ(renderer->releases.back(), window->session().experiment()->id) << "nothing is taken over";
    EXPECT_EQ(renderer->requests.size(), before + 1);
    EXPECT_TRUE(QTest::qWaitFor([this] { return window->is_settled(); }, 60000));
    EXPECT_EQ(window->session().open_project().is_dirty(), was_dirty) << "it is no part of the project";
    start();
    EXPECT_EQ(renderer->machine.processor, Body::gl);
    open_by_key();
    EXPECT_EQ(processor()->currentText(), "OpenGL device");
    QTest::mouseClick(dialog()->findChild<QToolButton*>("reset:processor"), Qt::LeftButton);
    EXPECT_EQ(renderer->machine.processor, Body::automatic);
    start();
    EXPECT_EQ(renderer->machine.processor, Body::automatic);
}

TEST_F(PreferencesWindowTest, MemoryThreadsAndDraftsCountAtOnce) {
    start();
    open_scene();
    open_by_key();
    type("memory", "1.5");
    EXPECT_EQ(renderer->requests.back().memory_budget, 1'500'000'000u);
    const auto before = renderer->requests.size();
    type("threads", "3");
    EXPECT_EQ(renderer->machine.threads, 3);
    EXPECT_EQ(renderer->requests.size(), before) << "the picture is the same";
    EXPECT_TRUE(renderer->requests.back().drafts);
    QTest::mouseClick(editor("drafts")->findChild<QCheckBox*>(), Qt::LeftButton, {}, QPoint(8, 8));
    window->action("rerun")->trigger();
    EXPECT_FALSE(renderer->requests.back().drafts);
    ASSERT_TRUE(QTest::qWaitFor([this] { return window->is_settled(); }, 60000));
}

TEST_F(PreferencesWindowTest, WhatTheCommandLineSetsIsShownAndStays) {
    start();
    open_by_key();
    EXPECT_FALSE(dialog()->findChild<QLabel*>("given")->isVisible());
    choose_next_processor();
    start({.memory = "2GB", .processor = "host"});
    EXPECT_EQ(renderer->machine.processor, Body::host);
    EXPECT_EQ(renderer->machine.memory, 2);
    open_by_key();
    EXPECT_EQ(dialog()->findChild<QLabel*>("given")->text(),
              "Set on the command line for this run: --memory 2GB, --processor host.");
    EXPECT_TRUE(dialog()->findChild<QLabel*>("given")->isVisible());
    EXPECT_FALSE(processor()->isEnabled());
    EXPECT_EQ(processor()->currentText(), "Host");
    EXPECT_TRUE(editor("processor")->toolTip().contains("--processor host"));
    EXPECT_TRUE(editor("threads")->isEnabled());
    start();
    EXPECT_EQ(renderer->machine.processor, Body::gl) << "what was chosen before";
}

TEST_F(PreferencesWindowTest, WhatIsNotAllowedInTheFileCountsAsNotChosen) {
    QSettings().setValue("preferences/processor", "abacus");
    QSettings().setValue("preferences/threads", -5);
    start();
    EXPECT_EQ(renderer->machine.processor, Body::automatic);
    EXPECT_EQ(renderer->machine.threads, 0);
}

}  // namespace
}  // namespace ir::gui
