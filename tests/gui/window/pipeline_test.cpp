#include <QCheckBox>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QDockWidget>
#include <QHelpEvent>
#include <QMenu>
#include <QPointer>
#include <QToolButton>
#include <QToolTip>
#include <QTreeView>

#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/rows_panel.h"

namespace ir::gui {
namespace {

/// A frame of two passes that write the picture in turn, and one that nobody needs.
class PipelineWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        renderer.overwrites = true;
        open_scene();
        trigger("dock-pipeline");
        window.findChild<QDockWidget*>("pipeline")->setFloating(true);
        window.findChild<QDockWidget*>("pipeline")->resize(700, 600);
        ASSERT_TRUE(QTest::qWaitFor([this] { return view().place_of("fade").isValid(); }, 60000));
        ASSERT_TRUE(settle());
    }
    widgets::PipelinePanel& panel() { return *window.findChild<widgets::PipelinePanel*>(); }
    widgets::PipelineView& view() { return panel().view(); }
    void click(const char* key) {
        const auto place = view().place_of(key);
        ASSERT_TRUE(view().viewport()->rect().contains(place.center())) << key;
        QTest::mouseClick(view().viewport(), Qt::LeftButton, {}, place.center());
        ASSERT_TRUE(settle());
    }
    void press(const char* button) {
        QTest::mouseClick(panel().findChild<QToolButton*>(button), Qt::LeftButton);
        ASSERT_TRUE(settle());
    }
    std::string step() { return window.live().step(window.session().experiment()->id).after; }
};

TEST_F(PipelineWindowTest, AClickOnABufferShowsIt) {
    EXPECT_TRUE(view().place_of("cover").isNull()) << "nobody looks at it";
    click("depth");
    EXPECT_EQ(window.views().shown_key(), "depth");
    click("picture");
    EXPECT_EQ(window.views().shown_key(), "picture");
    auto* skipped = panel().findChild<QCheckBox*>("skipped");
    EXPECT_FALSE(skipped->isChecked());
    click("skipped ");  // the mark of the pass that did not run
    EXPECT_TRUE(skipped->isChecked());
    ASSERT_TRUE(QTest::qWaitFor([this] { return view().place_of("cover").isValid(); }, 60000));
    EXPECT_TRUE(view().place_of("skipped ").isNull()) << "in place of the mark";
    click("look");
    EXPECT_EQ(step(), "") << "a pass that did not run leaves nothing";
}

TEST_F(PipelineWindowTest, AMenuLeadsOnFromAPassAndFromABuffer) {
    const auto menu_of = [this](const char* key) -> QMenu* {
        const auto place = view().place_of(key).center();
        QContextMenuEvent wanted(QContextMenuEvent::Mouse, place, view().viewport()->mapToGlobal(place));
        QApplication::sendEvent(view().viewport(), &wanted);
        auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
        if (!menu) ADD_FAILURE() << key;
        return menu;
    };
    const auto entry = [](QMenu* menu, const char* name) -> QAction* {
        for (auto* action : menu->actions())
            if (action->objectName() == name) return action;
        ADD_FAILURE() << name;
        return nullptr;
    };
    click("depth");  // what nobody looks at is not there
    QPointer<QMenu> menu = menu_of("paint");
    ASSERT_TRUE(menu);
    const auto buffers = entry(menu, "pass-buffers")->menu()->actions();
    ASSERT_EQ(buffers.size(), 2);
    EXPECT_EQ(buffers[1]->text(), "Depth");
    const auto copies = entry(menu, "pass-copy")->menu()->actions();
    ASSERT_EQ(copies.size(), 1);
    EXPECT_EQ(copies[0]->text(), "lib/random.glsl");
    buffers[1]->trigger();
    ASSERT_TRUE(settle());
    ASSERT_EQ(window.workspace().area().open_views().size(), 2u);
    EXPECT_EQ(window.views().state(1).a.output, "depth");
    const auto place = [] { return QGuiApplication::clipboard()->text(); };  // no editor is chosen
    copies[0]->trigger();
    const auto copy = place();
    EXPECT_TRUE(copy.endsWith("random.glsl:1")) << copy.toStdString();
    entry(menu, "pass-open")->menu()->actions().at(0)->trigger();
    EXPECT_TRUE(place().endsWith("shaders/lib/random.glsl:1")) << place().toStdString();
    EXPECT_NE(place(), copy);
    entry(menu, "pass-step")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(step(), "paint");
    menu->close();
    menu = menu_of("fade");
    ASSERT_TRUE(menu);
    EXPECT_FALSE(entry(menu, "pass-copy")->isEnabled());
    EXPECT_TRUE(entry(menu, "pass-copy")->toolTip().contains("no shader"));
    menu->close();
    menu = menu_of("depth");
    ASSERT_TRUE(menu);
    EXPECT_TRUE(entry(menu, "buffer-show")->isEnabled());
    EXPECT_TRUE(menu->actions().contains(window.action("pin"))) << "as in the list of buffers";
    entry(menu, "buffer-show")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().shown_key(), "depth");
    menu->close();
}

TEST_F(PipelineWindowTest, WhereThePassHasNotWrittenTheBufferItsOwnAreOffered) {
    auto* written = panel().findChild<QLabel*>("written");
    click("paint");
    EXPECT_TRUE(written->isHidden()) << "the picture is among them";
    window.views().show_output("cover");
    ASSERT_TRUE(settle());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !written->isHidden(); }, 60000));
    EXPECT_TRUE(written->text().contains("<a href='picture'>Picture</a>")) << written->text().toStdString();
    emit written->linkActivated("picture");
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().shown_key(), "picture");
    EXPECT_TRUE(QTest::qWaitFor([&] { return written->isHidden(); }, 60000));
}

TEST_F(PipelineWindowTest, StepsShowTheBufferAsEachPassLeftIt) {
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    click("paint");
    EXPECT_EQ(step(), "paint");
    EXPECT_FLOAT_EQ(pixel(), 0.125f) << "before the other pass";
    EXPECT_EQ(label("step"), "after pass 1 of 2, “paint”");
    EXPECT_TRUE(window.view().picture()->label.contains("after “paint”"));
    const auto frames = renderer.requests.size();
    press("pass-next");
    EXPECT_EQ(step(), "fade");
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    EXPECT_GT(renderer.requests.size(), frames);
    press("pass-next");
    EXPECT_EQ(step(), "") << "the whole frame";
    EXPECT_EQ(label("step"), "");
    EXPECT_FALSE(panel().findChild<QToolButton*>("whole-frame")->isEnabled());
    press("pass-before");
    EXPECT_EQ(step(), "fade");
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Up);
    EXPECT_EQ(step(), "paint");
    press("whole-frame");
    EXPECT_EQ(step(), "");
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
}

class ListStepsWindowTest : public PipelineWindowTest {
  protected:
    void SetUp() override {
        renderer.overwrites_lists = true;
        PipelineWindowTest::SetUp();
    }
    void show(const char* key) {
        window.views().show_output(key);
        ASSERT_TRUE(settle());
    }
};

TEST_F(ListStepsWindowTest, ATableShowsTheListAsAPassLeftIt) {
    show("numbers");
    auto& table = window.workspace().active_pane().table();
    const auto title = [&] {
        QStringList texts;
        for (const auto* each : table.findChildren<QLabel*>()) texts << each->text();
        return texts.join('|');
    };
    EXPECT_EQ(table.model().rowCount(), 6);
    table.set_filter("count >= 1");
    EXPECT_EQ(table.model().rowCount(), 5);
    click("paint");
    EXPECT_EQ(renderer.requests.back().after, "paint");
    EXPECT_EQ(table.model().buffer().elements, 3u);
    EXPECT_EQ(table.model().rowCount(), 2) << "filtered as before";
    EXPECT_TRUE(title().contains("Numbers · after “paint”")) << title().toStdString();
    press("pass-next");
    EXPECT_EQ(table.model().buffer().elements, 6u);
    EXPECT_TRUE(title().contains("after “fade”")) << title().toStdString();
    press("pass-next");
    EXPECT_FALSE(title().contains("after")) << title().toStdString();
}

TEST_F(ListStepsWindowTest, ATableStaysUntilThatOfTheStepIsThere) {
    show("numbers");
    auto& table = window.workspace().active_pane().table();
    renderer.hold = true;
    view().setFocus();
    const auto place = view().place_of("paint").center();
    QTest::mouseClick(view().viewport(), Qt::LeftButton, {}, place);
    ASSERT_EQ(step(), "paint");
    QApplication::processEvents();
    EXPECT_EQ(table.model().buffer().elements, 6u);
    EXPECT_EQ(table.reason(), "");
    renderer.hold = false;
    renderer.answer(renderer.requests.back(), renderer.requests.size());
    ASSERT_TRUE(settle());
    EXPECT_EQ(table.model().buffer().elements, 3u);
}

TEST_F(ListStepsWindowTest, WhatIsNotWrittenByThenIsSaid) {
    show("cloud");
    auto& space = window.workspace().active_pane().space().view();
    ASSERT_TRUE(QTest::qWaitFor([&] { return space.picture().layers.size() == 1; }));
    EXPECT_EQ(space.picture().moment, "");
    click("paint");
    ASSERT_TRUE(QTest::qWaitFor([&] { return space.picture().moment == "after “paint”"; }));
    EXPECT_EQ(renderer.views.back().view.after, "paint");
    const std::string reason =
        "“Cloud” is not written yet when “paint” has run.\nThat pass has written Picture: click one in "
        "Pipeline.";
    EXPECT_EQ(space.picture().layers.at(0).note, reason);
    auto state = window.views().active_state();
    state.as_table = true;
    window.views().set_active_state(state);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.workspace().active_pane().table().reason().toStdString(), reason);
    press("pass-next");
    EXPECT_EQ(window.workspace().active_pane().table().model().buffer().elements, 6u);
}

TEST_F(PipelineWindowTest, AnotherMethodHasOtherPasses) {
    click("fade");
    ASSERT_EQ(step(), "fade");
    renderer.overwrites = false;
    type_level("0.5");
    EXPECT_EQ(step(), "") << "the pass is gone";
    EXPECT_FLOAT_EQ(pixel(), 0.5f);
}

TEST_F(PipelineWindowTest, WhatPassesDidToAPixelIsListed) {
    trigger("trace-pixel");
    EXPECT_NE(label("state").find("Mark a pixel first"), std::string::npos) << label("state");
    auto& shown = window.view();
    QTest::mouseClick(&shown, Qt::LeftButton, {}, shown.rect().center());
    trigger("trace-pixel");
    ASSERT_TRUE(renderer.requests.back().traced.has_value());
    const auto& rows = panel().changes().model().rows();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0].cells[2].text, "–");
    EXPECT_EQ(rows[2].cells[0].text, "fade");
    EXPECT_EQ(rows[2].cells[2].text, "0.5  0.5  0.5");
    EXPECT_EQ(rows[2].cells[3].text, "1  1  1");
    // A row leads to the buffer as the pass left it.
    auto* tree = panel().changes().view();
    ASSERT_TRUE(QTest::qWaitFor([&] { return tree->isVisible() && tree->height() > 60; }, 60000));
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {},
                      tree->visualRect(panel().changes().model().index(1, 1)).center());
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().shown_key(), "depth");
    EXPECT_EQ(step(), "paint");
    press("end-trace");
    EXPECT_FALSE(renderer.requests.back().traced.has_value());
    EXPECT_FALSE(tree->isVisible());
}

TEST_F(PipelineWindowTest, APanelThatIsNotSeenAsksForNoPictures) {
    ASSERT_TRUE(QTest::qWaitFor([this] { return renderer.requests.back().thumbnails; }, 60000));
    window.docks().hide("buffers");
    window.docks().hide("pipeline");
    ASSERT_TRUE(QTest::qWaitFor([this] { return !renderer.requests.back().thumbnails; }, 60000));
}

TEST_F(PipelineWindowTest, ItZoomsAndTellsWhatThingsAre) {
    const int before = view().place_of("paint").width();
    view().setFocus();
    QTest::keyClick(&view(), Qt::Key_Plus);
    EXPECT_GT(view().place_of("paint").width(), before);
    QTest::keyClick(&view(), Qt::Key_0);
    const auto frame = view().viewport()->rect();
    for (const char* key : {"paint", "fade", "picture", "depth"})
        EXPECT_TRUE(frame.contains(view().place_of(key))) << key;
    QHelpEvent help(QEvent::ToolTip, view().place_of("paint").center(), QPoint());
    QApplication::sendEvent(view().viewport(), &help);
    ASSERT_TRUE(QTest::qWaitFor([] { return QToolTip::isVisible(); }, 60000));
    EXPECT_TRUE(QToolTip::text().contains("on the host"));
}

TEST_F(PipelineWindowTest, WithoutAFrameItSaysSo) {
    window.session().files().close();
    QApplication::processEvents();
    const auto* empty = panel().findChild<QLabel*>("empty");
    EXPECT_TRUE(QTest::qWaitFor([&] { return empty->text().contains("shows no experiment"); }, 60000))
        << empty->text().toStdString();
}

}  // namespace
}  // namespace ir::gui
