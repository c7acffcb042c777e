#include <QClipboard>
#include <QDockWidget>
#include <QMenu>
#include <QTemporaryDir>

#include "tests/gui/window/window_fixture.h"
#include "widgets/plot/plot_view.h"

namespace ir::gui {
namespace {

/// Two views, of experiments with different values.
class ProfileWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        add_second_experiment(0.75);
        trigger("views-2");
        window.workspace().area().set_active(1);
        choose(header("owner-a"), QString::fromStdString(window.session().document().experiments[1].name));
        window.workspace().area().set_active(0);
    }
    widgets::ImageView& view(int number) { return window.workspace().pane(number)->compare().main_view(); }
    widgets::ProfilePanel& panel() { return window.profile().panel(); }
    bool is_seen() {
        QApplication::processEvents();
        return !window.findChild<QDockWidget*>("profile")->isHidden();
    }
    void draw(int number, QPoint from, QPoint to) {
        auto& shown = view(number);
        shown.look_at(QPointF(from + to) / 2, 4);
        const auto at = [&](QPoint pixel) {
            return (shown.transform().view_from_pixel(pixel) / shown.devicePixelRatioF()).toPoint();
        };
        QTest::mousePress(&shown, Qt::LeftButton, {}, at(from));
        QTest::mouseMove(&shown, at((from + to) / 2));
        QTest::mouseMove(&shown, at(to));
        EXPECT_FALSE(is_seen()) << "not below the hand";
        QTest::mouseRelease(&shown, Qt::LeftButton, {}, at(to));
        ASSERT_TRUE(settle());
    }
};

TEST_F(ProfileWindowTest, ADrawnLineBringsTheProfileOfAllViewsAndTakesItAway) {
    EXPECT_FALSE(is_seen());
    view(0).setFocus();
    QTest::keyClick(&view(0), Qt::Key_N);
    draw(0, {10, 8}, {40, 20});
    ASSERT_TRUE(is_seen());
    const auto* dock = window.findChild<QDockWidget*>("profile");
    EXPECT_TRUE(QTest::qWaitFor([&] { return dock->height() > 200; }, 60000)) << "its plot can be read";
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().profile().data().series.size() == 2; }, 60000));
    const auto& series = panel().profile().data().series;
    EXPECT_EQ(series[0].points.size(), 31u);
    EXPECT_NEAR(series[0].points[3].y, 0.25, 1e-6);
    EXPECT_NEAR(series[1].points[3].y, 0.75, 1e-6);
    EXPECT_NE(series[0].name, series[1].name);
    EXPECT_EQ(view(1).state().marks.line, QLine(10, 8, 40, 20));
    // A point of it is marked in both pictures.
    panel().profile().setFocus();
    for (const auto key : {Qt::Key_Home, Qt::Key_End}) QTest::keyClick(&panel().profile(), key);
    EXPECT_EQ(view(0).state().marks.picked, QPoint(40, 20));
    EXPECT_EQ(view(1).state().marks.picked, QPoint(40, 20));
    view(0).setFocus();
    QTest::keyClick(&view(0), Qt::Key_Escape);
    EXPECT_TRUE(view(1).state().marks.line.isNull());
    EXPECT_FALSE(is_seen()) << "it has nothing to say";
}

TEST_F(ProfileWindowTest, APanelThatCameByDrawingIsNotRemembered) {
    trigger("line");
    draw(0, {10, 8}, {40, 20});
    ASSERT_TRUE(is_seen());
    const QTemporaryDir folder;
    window.session().files().save_as(folder.filePath("left.interreflect").toStdString());
    window.leave();
    EXPECT_FALSE(is_seen()) << "the arrangement that is remembered has no such panel";
}

TEST_F(ProfileWindowTest, APanelThatSomebodyOpenedStays) {
    window.findChild<QDockWidget*>("profile")->show();
    ASSERT_TRUE(settle());
    trigger("line");
    view(0).setFocus();
    QTest::keyClick(&view(0), Qt::Key_Right);
    ASSERT_TRUE(settle());
    EXPECT_EQ(panel().profile().data().series.size(), 2u);
    QTest::keyClick(&view(0), Qt::Key_Escape);
    EXPECT_TRUE(is_seen());
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().histograms().data().series.size() == 2; }, 60000));
    // So does one behind another tab.
    window.docks().raise("results");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.docks().is_seen("profile"); }, 60000));
    ASSERT_TRUE(settle());
    QTest::keyClick(&view(0), Qt::Key_Right);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.docks().is_seen("profile"); }, 60000));
    ASSERT_TRUE(settle());
    QTest::keyClick(&view(0), Qt::Key_Escape);
    EXPECT_TRUE(is_seen());
}

TEST_F(ProfileWindowTest, AClosedPanelComesBackWhenSomethingIsDrawn) {
    trigger("line");
    draw(0, {10, 8}, {40, 20});
    ASSERT_TRUE(is_seen());
    window.docks().hide("profile");
    ASSERT_TRUE(settle());
    QTest::mouseClick(&view(0), Qt::LeftButton, {}, QPoint(3, 3));
    EXPECT_FALSE(is_seen()) << "that drew nothing";
    view(0).setFocus();
    QTest::keyClick(&view(0), Qt::Key_Down);
    EXPECT_TRUE(is_seen());
}

TEST_F(ProfileWindowTest, ARectangleIsMeasuredUnlessMetricsDo) {
    trigger("rectangle");
    draw(0, {10, 8}, {19, 12});
    ASSERT_TRUE(is_seen());
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().histograms().data().title == "10 × 5 pixels at 10, 8"; },
                                60000));
    QTest::keyClick(&view(0), Qt::Key_Escape);
    EXPECT_FALSE(is_seen());
    window.findChild<QDockWidget*>("metrics")->raise();
    ASSERT_TRUE(settle());
    draw(0, {10, 8}, {19, 12});
    EXPECT_FALSE(is_seen());
}

TEST_F(ProfileWindowTest, PicturesOfAnotherSizeAreLeftOutAndSaid) {
    const auto second = window.session().document().experiments[1].id;
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_size(project, second, {40, 30});
    });
    ASSERT_TRUE(settle());
    trigger("line");
    draw(0, {10, 8}, {40, 20});
    ASSERT_TRUE(is_seen());
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel().profile().data().series.size() == 1; }, 60000));
    EXPECT_EQ(panel().fields().note, "One picture has another size");
}

TEST_F(ProfileWindowTest, LineAndChoicesAreKeptWithTheProject) {
    const QTemporaryDir folder;
    trigger("line");
    draw(0, {10, 8}, {40, 20});
    panel().set_logarithmic(true);
    panel().set_choice(1);
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
    trigger("close");
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    EXPECT_EQ(view(0).state().marks.line, QLine(10, 8, 40, 20));
    EXPECT_TRUE(panel().is_logarithmic());
    EXPECT_EQ(panel().choice(), 1);
    // A session file is free text.
    window.workspace().load(projects::Json::parse(R"({"line":{"of":[8,8],"x1":2,"x2":1e300,"y2":"b"}})"));
    EXPECT_TRUE(window.workspace().tools().line().isNull());
    window.profile().load(projects::Json::parse(R"({"profile":{"channel":1e300,"logarithmic":3}})"));
    EXPECT_FALSE(panel().is_logarithmic());
    ASSERT_TRUE(settle());
}

TEST_F(ProfileWindowTest, TheViewIsCopiedAsShown) {
    QApplication::clipboard()->clear();
    view(0).setFocus();
    QTest::keyClick(&view(0), Qt::Key_C, Qt::ControlModifier | Qt::ShiftModifier);
    const auto copied = QApplication::clipboard()->image();
    const auto shown = window.workspace().active_pane().snapshot(true);
    ASSERT_EQ(copied.size(), shown.size());
    EXPECT_EQ(copied.convertToFormat(shown.format()), shown);
    // Pictures' menu has it, and both tools.
    QStringList names;
    for (const auto* menu : window.findChildren<QMenu*>())
        if (menu->actions().contains(window.action("copy-view")) &&
            menu->actions().contains(window.action("explain")))
            for (const auto* action : menu->actions()) names << action->objectName();
    for (const char* name : {"copy-view", "line", "rectangle"}) EXPECT_TRUE(names.contains(name)) << name;
}

}  // namespace
}  // namespace ir::gui
