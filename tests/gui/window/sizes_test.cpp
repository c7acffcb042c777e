#include <QDockWidget>
#include <QMenu>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QStyleOption>
#include <QTabBar>
#include <QToolButton>

#include "app/engine/execution.h"
#include "app/gui/dock_layout.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/parameters/parameter_panel.h"

namespace ir::gui {
namespace {

class SizesTest : public WindowTest {
  protected:
    void show_four(const char* output) {
        open_scene();
        trigger("views-4");
        for (int view = 0; view < 4; ++view) {
            window.workspace().area().set_active(view);
            window.views().show_output(output);
        }
        ASSERT_TRUE(settle());
    }
    void expect_fits(QSize smallest = min_size_for_all_panels) {
        const auto least = window.minimumSizeHint();
        EXPECT_LE(least.width(), smallest.width()) << widest().toStdString();
        EXPECT_LE(least.height(), smallest.height()) << widest().toStdString();
        window.resize(smallest);
        QApplication::processEvents();
        EXPECT_LE(window.width(), smallest.width());
        EXPECT_LE(window.height(), smallest.height());
    }
    /// The least sizes of all panels, for whoever has to mend this.
    QString widest() {
        QString text = "centre " + size_text(window.centralWidget()->minimumSizeHint());
        for (const auto* dock : window.findChildren<QDockWidget*>())
            if (!dock->isHidden())
                text += "\n" + dock->objectName() + " " + size_text(dock->minimumSizeHint());
        return text;
    }
    static QString size_text(QSize size) {
        return QString::number(size.width()) + " x " + QString::number(size.height());
    }
};

TEST_F(SizesTest, FourViewsInSpaceFitTheSmallestScreen) {
    show_four("cloud");
    for (int view = 0; view < 4; ++view) window.workspace().pane(view)->space().set_panel_shown(view < 2);
    ASSERT_TRUE(settle());
    expect_fits();
}

TEST_F(SizesTest, EachViewThatIsOpenedHasAFairShareOfTheRoom) {
    window.resize(1280, 770);
    open_scene();
    const auto expect_fair = [&](std::size_t count) {
        const auto& area = window.workspace().area();
        ASSERT_EQ(area.open_views().size(), count);
        for (const int view : area.open_views()) {
            const auto* dock = area.dock(view);
            // Titles and the gaps between views have their share, too.
            EXPECT_TRUE(QTest::qWaitFor([&] {
                return dock->width() > area.width() / 4 - 10 && dock->height() > area.height() / 4;
            })) << view
                << ": " << size_text(dock->size()).toStdString() << " of "
                << size_text(area.size()).toStdString();
        }
    };
    trigger("set-up-space");  // things in the scene, and a sphere of directions
    expect_fair(3);
    trigger("views-1");
    window.inspector().explain({2, 2});
    ASSERT_TRUE(settle());
    expect_fair(2);
}

/// 1920×1200 at twice the scale.
TEST_F(SizesTest, OnASmallScreenPanelsOfBothSidesStandBehindEachOther) {
    const QRect available(0, 0, 960, 600);
    window.docks().fit(available);
    show_four("cloud");
    window.docks().apply("default");
    trigger("views-4");
    for (int view = 0; view < 4; ++view) window.workspace().area().set_active(view);
    ASSERT_TRUE(settle());
    expect_fits({960, 570});
    auto* buffers = window.findChild<QDockWidget*>("buffers");
    EXPECT_FALSE(buffers->isHidden());
    EXPECT_EQ(window.dockWidgetArea(buffers), Qt::LeftDockWidgetArea);
    window.docks().fit(QRect(0, 0, 1920, 1200));
    window.docks().apply("default");
    EXPECT_EQ(window.dockWidgetArea(buffers), Qt::RightDockWidgetArea);
}

TEST_F(SizesTest, PanelsBesideTheViewsAreWiderOnALargeScreen) {
    const auto* buffers = window.findChild<QDockWidget*>("buffers");
    window.resize(1280, 770);
    window.docks().restore_default();
    ASSERT_TRUE(settle());
    EXPECT_NEAR(buffers->width(), 340, 10);
    // By itself: the window grows onto a large screen.
    window.resize(3840, 2160);
    ASSERT_TRUE(settle());
    EXPECT_TRUE(QTest::qWaitFor([&] { return buffers->width() > 490; })) << buffers->width();
    window.docks().restore_default();
    ASSERT_TRUE(settle());
    EXPECT_NEAR(buffers->width(), 500, 10);
    // What a hand made wide stays so.
    window.resizeDocks({window.findChild<QDockWidget*>("buffers")}, {700}, Qt::Horizontal);
    ASSERT_TRUE(settle());
    window.resize(3000, 2160);
    window.resize(3840, 2160);
    ASSERT_TRUE(settle());
    EXPECT_NEAR(buffers->width(), 700, 10);
}

TEST_F(WindowTest, ASmallScreenHasAnArrangementOfItsOwn) {
    const QRect small(0, 0, 960, 600), large(0, 0, 1920, 1200);
    const auto dock = [](MainWindow& of, const char* name) { return of.findChild<QDockWidget*>(name); };
    const auto area = [&] { return window.dockWidgetArea(dock(window, "buffers")); };
    window.docks().fit(small);
    open_scene();  // after the start
    trigger("views-4");
    for (int view = 0; view < 4; ++view) {
        window.workspace().area().set_active(view);
        window.views().show_output("cloud");
    }
    ASSERT_TRUE(settle());
    EXPECT_EQ(area(), Qt::LeftDockWidgetArea);
    EXPECT_LE(window.minimumSizeHint().width(), small.width());
    EXPECT_LE(window.minimumSizeHint().height(), 570);
    dock(window, "timings")->hide();
    window.docks().fit(large);
    EXPECT_EQ(area(), Qt::RightDockWidgetArea);
    EXPECT_FALSE(dock(window, "timings")->isHidden());
    EXPECT_EQ(window.workspace().area().open_views().size(), 4u) << "views stay";
    window.docks().fit(small);
    EXPECT_EQ(area(), Qt::LeftDockWidgetArea);
    EXPECT_TRUE(dock(window, "timings")->isHidden());

    for (const bool begins : {true, false}) {
        FakeRenderer another_renderer;
        MainWindow another(another_renderer, fake_registry(), {.remember = true, .surface = painted});
        another.docks().fit(small);
        ASSERT_TRUE(another.open_path("builtin:cornell"));
        EXPECT_EQ(dock(another, "timings")->isHidden(), !begins) << "remembered";
        dock(another, "timings")->hide();
        another.session().files().close();
        another.close();
    }
    QSettings().remove("window");
}

TEST_F(SizesTest, FourComparisonsFitTheSmallestScreen) {
    show_four("");
    for (const auto mode : widgets::all_modes()) {
        for (int view = 0; view < 4; ++view) {
            window.workspace().area().set_active(view);
            window.views().set_mode(mode);
        }
        ASSERT_TRUE(settle());
        expect_fits();
    }
}

TEST_F(SizesTest, ListsOfFourComparisonsKeepTwelveLetters) {
    show_four("");
    for (int view = 0; view < 4; ++view) {
        window.workspace().area().set_active(view);
        window.views().set_mode(widgets::ViewMode::difference);
    }
    window.docks().apply("default");
    trigger("views-4");
    window.resize(1280, 770);
    ASSERT_TRUE(settle());
    for (int view = 0; view < 4; ++view)
        for (const char* list : {"owner-a", "output-a", "owner-b", "output-b"}) {
            auto* combo = window.workspace().pane(view)->header().findChild<QComboBox*>(list);
            ASSERT_TRUE(combo->isVisible());
            QStyleOptionComboBox option;
            option.initFrom(combo);
            const auto field = combo->style()->subControlRect(QStyle::CC_ComboBox, &option,
                                                              QStyle::SC_ComboBoxEditField, combo);
            EXPECT_GE(field.width(), combo->fontMetrics().horizontalAdvance("Ambient occl"))
                << list << " of view " << view;
        }
    auto* more = window.workspace().active_pane().header().findChild<QToolButton*>("more");
    const auto choose_in_menu = [&](const QString& text) {
        emit more->menu()->aboutToShow();
        for (auto* action : more->menu()->actions())
            if (action->text() == text) return action->trigger();
        ADD_FAILURE() << text.toStdString();
    };
    ASSERT_TRUE(more->isVisible());
    choose_in_menu(widgets::difference_name(DifferenceKind::absolute));
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().active_state().difference, DifferenceKind::absolute);
    choose_in_menu(widgets::mode_name(widgets::ViewMode::wipe));
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().active_state().mode, widgets::ViewMode::wipe);
    const bool linked = window.workspace().views().linked();
    choose_in_menu(
        window.workspace().active_pane().header().findChild<QToolButton*>("link")->accessibleName());
    EXPECT_NE(window.workspace().views().linked(), linked);
    trigger("views-1");
    window.resize(1600, 1000);
    ASSERT_TRUE(settle());
    EXPECT_FALSE(more->isVisible()) << "there is room";
    EXPECT_TRUE(header("mode")->isVisible());
}

TEST_F(SizesTest, FourTablesFitTheSmallestScreen) {
    show_four("numbers");
    expect_fits();
}

TEST_F(SizesTest, CurvesAreAsHighAsAViewWhereTheyAreOpened) {
    open_scene();
    window.resize(1280, 770);
    trigger("dock-messages");
    EXPECT_LT(window.findChild<QDockWidget*>("messages")->height(), window.height() / 3);
    for (const char* name : {"plots", "timeline", "results"}) {
        window.docks().restore_default();
        trigger((std::string("dock-") + name).c_str());
        const auto* dock = window.findChild<QDockWidget*>(name);
        EXPECT_TRUE(QTest::qWaitFor([&] { return dock->height() >= window.height() / 3; }))
            << name << ": " << dock->height();
    }
    // What says less takes less from the pictures.
    for (const auto& [name, most] : {std::pair("frames", 140), std::pair("profile", 310)}) {
        window.docks().apply("picture");
        trigger((std::string("dock-") + name).c_str());
        const auto* dock = window.findChild<QDockWidget*>(name);
        EXPECT_TRUE(QTest::qWaitFor([&] { return dock->height() <= most; }))
            << name << ": " << dock->height();
    }
    for (const auto* tabs : window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
        EXPECT_EQ(tabs->elideMode(), Qt::ElideNone) << "names that can be read";
}

TEST(WindowGeometry, IsWithinWhatTheScreenOffers) {
    const QRect screen(0, 30, 960, 570);
    EXPECT_EQ(within(QRect(100, 100, 1440, 900), screen, 20), QRect(0, 50, 960, 550));
    EXPECT_EQ(within(QRect(100, 100, 300, 200), screen, 20), QRect(100, 100, 300, 200));
    EXPECT_EQ(within(QRect(900, 500, 300, 200), screen, 20), QRect(660, 400, 300, 200));
    EXPECT_EQ(within(QRect(-50, 0, 300, 200), screen, 20), QRect(0, 50, 300, 200));
}

TEST_F(WindowTest, OpensWithinTheScreen) {
    const auto available = window.screen()->availableGeometry();
    for (const QSize remembered : {QSize(), QSize(4000, 3000)}) {
        QSettings().remove("window/geometry");
        if (!remembered.isEmpty()) {
            window.resize(remembered);
            QSettings().setValue("window/geometry", window.saveGeometry());
        }
        FakeRenderer fresh_renderer;
        MainWindow fresh(fresh_renderer, fake_registry(), {.remember = true, .surface = painted});
        fresh.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&fresh));
        EXPECT_TRUE(available.contains(fresh.frameGeometry()))
            << fresh.width() << " x " << fresh.height() << " on " << available.width() << " x "
            << available.height();
    }
    QSettings().remove("window/geometry");
}

/// With the parameters of the methods that come with the program.
TEST_F(WindowTest, ParametersNeverScrollSideways) {
    open_scene();
    window.docks().apply("default");
    auto* scroll = qobject_cast<QScrollArea*>(window.findChild<QDockWidget*>("parameters")->widget());
    ASSERT_TRUE(scroll);
    auto* panel = scroll->findChild<widgets::ParameterPanel*>();
    ASSERT_TRUE(panel);
    for (const auto* method : engine::registry().methods()) {
        panel->set_parameters(method->id, method->parameters);
        panel->set_values({});
        for (auto* label : panel->findChildren<QLabel*>()) {  // as where each value was changed
            auto font = label->font();
            font.setBold(true);
            label->setFont(font);
        }
        QApplication::processEvents();
        const auto room = scroll->minimumWidth() - 2 * scroll->frameWidth() -
                          scroll->verticalScrollBar()->sizeHint().width();
        EXPECT_GT(panel->minimumSizeHint().width(), 100) << method->id;
        EXPECT_LE(scroll->widget()->minimumSizeHint().width(), room) << method->id;
    }
}

}  // namespace
}  // namespace ir::gui
