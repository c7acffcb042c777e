#include <QCheckBox>
#include <QDockWidget>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <future>
#include <utility>

#include "app/gui/dialog_folder.h"
#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "tests/fake_tev.h"
#include "tests/gui/events.h"
#include "tests/gui/window/inspect_fixture.h"
#include "tests/unit/scarce_disk.h"
#include "widgets/inspect/display_panel.h"
#include "widgets/panels/action_text.h"

namespace ir::gui {
namespace {

TEST_F(InspectWindowTest, ThePixelUnderTheCursorIsReadFromAllImages) {
    raise("inspector");
    move_to({12, 7});
    ASSERT_TRUE(QTest::qWaitFor([&] { return !renderer.probes.empty(); }, 60000));
    auto& model = window.inspector().panel().model();
    ASSERT_TRUE(QTest::qWaitFor([&] { return model.readings().cursor == QPoint(12, 7); }, 60000));
    const QString text = window.inspector().panel().csv();
    EXPECT_TRUE(text.contains("712")) << text.toStdString();
    EXPECT_TRUE(text.contains("depth"));
}

TEST_F(InspectWindowTest, PinsStayWithTheProject) {
    const QTemporaryDir folder;
    raise("inspector");
    pin({12, 7});
    pin({3, 4});
    ASSERT_EQ(window.inspector().pins().size(), 2u);
    EXPECT_EQ(window.inspector().pins()[0], QPoint(12, 7));
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
    trigger("close");
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    EXPECT_EQ(window.inspector().pins().size(), 2u);
}

TEST_F(InspectWindowTest, PanelsThatAreNotSeenAskForNothing) {
    raise("buffers");
    renderer.probes.clear();
    move_to({12, 7});
    move_to({13, 7});
    test::handle_events();
    EXPECT_TRUE(renderer.probes.empty());
}

TEST_F(InspectWindowTest, ShiftClickExplainsAPixelAndDrawsItInSpace) {
    QTest::mouseMove(&window.view(), place_of({20, 10}));
    QTest::mouseClick(&window.view(), Qt::LeftButton, Qt::ShiftModifier, place_of({20, 10}));
    ASSERT_TRUE(settle());
    ASSERT_TRUE(window.inspector().explained().has_value());
    EXPECT_EQ(*window.inspector().explained(), QPoint(20, 10));
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.workspace().area().open_views().size() == 2; }, 60000));
    const auto& state = window.views().state(1);
    EXPECT_EQ(state.a.output, "why");
    ASSERT_TRUE(QTest::qWaitFor([&] { return !renderer.views.empty(); }, 60000));
    EXPECT_EQ(renderer.views.back().view.layers[0].key, "why");
    EXPECT_EQ(renderer.requests.back().inspection.x, 20);
    EXPECT_EQ(renderer.requests.back().inspection.y, 10);
    EXPECT_EQ(window.workspace().area().active(), 0);
    trigger("explain-nothing");
    EXPECT_FALSE(window.inspector().explained().has_value());
}

TEST_F(InspectWindowTest, ADragWithShiftExplainsNothing) {
    const auto from = place_of({20, 10});
    QTest::mousePress(&window.view(), Qt::LeftButton, Qt::ShiftModifier, from);
    QTest::mouseMove(&window.view(), from + QPoint(15, 0));
    QTest::mouseMove(&window.view(), from + QPoint(30, 0));
    QTest::mouseRelease(&window.view(), Qt::LeftButton, Qt::ShiftModifier, from + QPoint(30, 0));
    ASSERT_TRUE(settle());
    EXPECT_FALSE(window.inspector().explained().has_value()) << "the picture was moved";
}

TEST_F(InspectWindowTest, WhatExplainsAPixelNeverCoversThePicture) {
    window.inspector().explain({20, 10});
    ASSERT_TRUE(settle());
    const auto picture = window.views().state(0);
    for (const char* key : {"why", "shares", "why"}) {
        emit window.inspector().explain_panel().show_wanted(key);
        ASSERT_TRUE(settle());
        EXPECT_EQ(window.views().state(0), picture) << key;
        EXPECT_EQ(window.workspace().area().active(), 0);
    }
    const auto open = window.workspace().area().open_views();
    ASSERT_EQ(open.size(), 3u);
    EXPECT_EQ(window.views().state(1).a.output, "why");
    EXPECT_EQ(window.views().state(2).a.output, "shares");
}

TEST_F(InspectWindowTest, EachSpaceOfAnExplanationHasAViewOfItsOwn) {
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_method(project, fake_registry(), window.session().experiment()->id,
                                           "truth");
    });
    ASSERT_TRUE(settle());
    for (const char* views : {"views-1", "views-4"}) {  // with room for new views, and without
        trigger(views);
        auto& workspace = window.workspace();
        window.inspector().explain_nothing();
        widgets::ViewState picture;
        picture.a = {window.session().experiment()->id, {}};
        for (const int view : workspace.area().open_views()) window.views().set_state(view, picture);
        ASSERT_TRUE(settle());
        window.inspector().explain({20, 10});
        ASSERT_TRUE(settle());
        std::map<std::string, std::vector<std::string>> layers;
        for (const int view : workspace.area().open_views()) {
            const auto& state = window.views().state(view);
            if (workspace.pane(view)->content() != widgets::ViewPane::Content::space) continue;
            for (const auto& layer : state.space.layers) layers[state.a.output].push_back(layer.key);
        }
        EXPECT_EQ(layers["why"], std::vector<std::string>{"why"}) << views;
        EXPECT_EQ(layers["grid"], std::vector<std::string>{"grid"}) << views;
        EXPECT_EQ(window.views().active_state(), picture) << views;
    }
}

TEST_F(InspectWindowTest, ABufferOfAnotherSpaceLeavesTheCameraBehind) {
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_method(project, fake_registry(), window.session().experiment()->id,
                                           "truth");
    });
    ASSERT_TRUE(settle());
    window.inspector().explain({20, 10});
    ASSERT_TRUE(settle());
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    window.workspace().active_pane().space().view().use_free_camera();
    ASSERT_TRUE(settle());
    ASSERT_TRUE(window.views().active_state().space.camera.has_value());
    window.views().show_output("why");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window.views().active_state().space.camera.has_value()) << "still in the scene";
    window.views().show_output("grid");
    ASSERT_TRUE(settle());
    EXPECT_FALSE(window.views().active_state().space.camera.has_value());
}

TEST_F(InspectWindowTest, AnExplanationIsNoEdit) {
    const auto position = steps();
    window.inspector().explain({1, 2});
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), position);
}

TEST_F(InspectWindowTest, DisplayIsRememberedByBuffer) {
    const double brighter = window.workspace().display().exposure + 0.5;
    trigger("brighter");
    EXPECT_DOUBLE_EQ(window.workspace().display().exposure, brighter);
    window.views().show_output("depth");
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window.workspace().is_automatic());
    auto display = window.workspace().display();
    display.high = 7;
    window.views().choose_display(display);
    trigger("buffer-main");
    EXPECT_DOUBLE_EQ(window.workspace().display().exposure, brighter);
    window.views().show_output("depth");
    ASSERT_TRUE(settle());
    EXPECT_DOUBLE_EQ(window.workspace().display().high, 7);
    trigger("display-reset");
    EXPECT_TRUE(window.workspace().is_automatic());
}

TEST_F(InspectWindowTest, ZebraAndMarksAreSwitchedByKeys) {
    const auto *marks = window.action("marks"), *zebra = window.action("zebra");
    EXPECT_TRUE(marks->isChecked());
    EXPECT_FALSE(zebra->isChecked());
    QTest::keyClick(&window.view(), Qt::Key_Z);
    EXPECT_TRUE(window.view().display().zebra);
    EXPECT_TRUE(zebra->isChecked());
    QTest::keyClick(&window.view(), Qt::Key_M);
    EXPECT_FALSE(window.view().display().mark_bad);
    EXPECT_FALSE(marks->isChecked());
    QTest::keyClick(&window.view(), Qt::Key_M);
    EXPECT_TRUE(window.view().display().mark_bad);
    EXPECT_TRUE(marks->isChecked());
}

TEST_F(InspectWindowTest, TheMenuCallsSwitchesOfTheDisplayAsThePanelDoesAndFollowsIt) {
    raise("display");
    for (const char* name : {"marks", "zebra"}) {
        auto* box = window.findChild<widgets::DisplayPanel*>()->findChild<QCheckBox*>(name);
        const auto* action = window.action(name);
        EXPECT_EQ(widgets::plain_text(action->text()), box->text());
        const bool before = action->isChecked();
        EXPECT_EQ(box->isChecked(), before) << name;
        box->click();
        EXPECT_EQ(action->isChecked(), !before) << name;
        trigger("display-reset");
        EXPECT_EQ(action->isChecked(), before) << name;
    }
    auto* reset = window.findChild<widgets::DisplayPanel*>()->findChild<QPushButton*>("automatic");
    EXPECT_EQ(widgets::plain_text(window.action("display-reset")->text()), reset->text());
}

TEST_F(InspectWindowTest, WhatIsShownIsExported) {
    const QTemporaryDir folder;
    const QString png = folder.path() + "/view.png", exr = folder.path() + "/buffer.exr",
                  csv = folder.path() + "/values.csv";
    window.export_controller().exports().save_view(png);
    EXPECT_FALSE(QImage(png).isNull());
    window.export_controller().exports().save_buffer(exr);
    const auto image = read_image(exr.toStdString());
    EXPECT_EQ(image.pixels, window.view().image().pixels);
    window.export_controller().exports().save_values(csv);
    QFile file(csv);
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readLine().trimmed(), "x,y,R,G,B");
    EXPECT_EQ(file.readLine().trimmed(), "0,0,0.25,0.25,0.25");
    window.export_controller().exports().save_all_buffers(folder.path() + "/all.exr");
    ASSERT_EQ(renderer.exports.size(), 1u);
    EXPECT_EQ(renderer.exports[0].tag, window.session().experiment()->id);
    window.views().show_output("numbers");
    ASSERT_TRUE(settle());
    window.export_controller().exports().save_values(csv);
    file.close();
    ASSERT_TRUE(file.open(QIODevice::ReadOnly));
    EXPECT_EQ(file.readAll().count('\n'), fake_elements + 1);
    EXPECT_THROW(window.export_controller().exports().save_buffer(exr), Error);
    EXPECT_THROW(window.export_controller().exports().save_view(folder.path() + "/no/such/folder.png"),
                 Error);
}

TEST_F(InspectWindowTest, TheShownBufferIsSentToTev) {
    FakeTev tev;
    auto received = std::async(std::launch::async, [&] { return tev.receive(); });
    window.export_controller().show_in_tev(tev.address());
    const auto shown = received.get();
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_EQ(shown.begin()->first, window.export_controller().exports().title().toStdString());
    EXPECT_EQ(shown.begin()->second.image.pixels, window.view().image().pixels);
    const auto labels = window.findChild<StatusLine*>()->findChildren<QLabel*>();
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return std::any_of(labels.begin(), labels.end(),
                           [](const auto* each) { return each->text() == "Shown in tev"; });
    }));
}

TEST_F(InspectWindowTest, ExportsThatDoNotFitOnTheDiskAreRefused) {
    const QTemporaryDir folder;
    const QString file = folder.path() + "/file.png";
    const auto refused = [&](void (Exports::*save)(const QString&) const) {
        return is_refused_without_room(file.toStdString(),
                                       [&] { (window.export_controller().exports().*save)(file); });
    };
    EXPECT_EQ(refused(&Exports::save_view), "");
    EXPECT_EQ(refused(&Exports::save_buffer), "");
    EXPECT_EQ(refused(&Exports::save_values), "");
    window.views().show_output("numbers");
    ASSERT_TRUE(settle());
    EXPECT_EQ(refused(&Exports::save_values), "");
}

TEST_F(InspectWindowTest, AFileThatTheRendererCannotWriteIsNotSaidToBeThere) {
    const QTemporaryDir folder;
    remember_export(folder.filePath("any"));
    renderer.export_error = "out of beads";
    bool is_entered = false;
    QTimer hand;  // the dialog has an event loop of its own
    QObject::connect(&hand, &QTimer::timeout, [&] {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        if (!dialog || std::exchange(is_entered, true)) return;
        QTest::keyClick(dialog->findChild<QLineEdit*>(), Qt::Key_Return);
    });
    hand.start(1);
    trigger("export-all");
    ASSERT_TRUE(is_entered);
    ASSERT_TRUE(
        QTest::qWaitFor([&] { return window.banners().text("file").contains("out of beads"); }, 60000));
    for (const auto* label : window.findChildren<QLabel*>()) EXPECT_FALSE(label->text().startsWith("Wrote"));
}

TEST_F(InspectWindowTest, AMessageLeadsToItsPlace) {
    window.messages().add({Severity::warning, "render", "look at this", "depth"});
    emit window.messages().go_to({Severity::warning, "render", "look at this", "depth"});
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().shown_key(), "depth");
}

TEST_F(InspectWindowTest, ACameraIsBookmarkedAndUsedAgain) {
    QTest::keyClick(&window, Qt::Key_B, Qt::ControlModifier);
    ASSERT_EQ(window.session().document().cameras.size(), 1u);
    const auto id = window.session().document().cameras[0].id;
    raise("project");
    emit window.document().tree().item_activated({widgets::ItemKind::camera, QString::fromStdString(id)});
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.session().experiment()->camera, id);
}

TEST_F(InspectWindowTest, AnEditInTheProjectPanelIsUndone) {
    raise("project");
    emit window.document().tree().edit_wanted([](const projects::Project& project) {
        return projects::edits::set_project_name(project, "renamed");
    });
    EXPECT_EQ(window.session().document().name, "renamed");
    trigger("undo");
    EXPECT_NE(window.session().document().name, "renamed");
}

TEST_F(InspectWindowTest, TheMenuOfAPictureIsAboutThePixelThatWasClicked) {
    auto& view = window.view();
    const QPoint at(view.width() / 2 + 40, view.height() / 2 - 30);
    QTest::mouseClick(&view, Qt::RightButton, {}, at);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(menu, nullptr);
    EXPECT_TRUE(menu->actions().contains(window.action("light-here")));
    EXPECT_TRUE(menu->actions().contains(window.action("explain")));
    menu->close();
    const auto picked = view.state().marks.picked;
    ASSERT_GE(picked.x(), 0);
    QTest::mouseMove(window.findChild<QWidget*>("project-tree"), {5, 5});
    QEvent leave(QEvent::Leave);
    QApplication::sendEvent(&view, &leave);  // as the menu makes it
    trigger("light-here");
    // The menu asks, too: it names what was clicked.
    const auto asked = std::ranges::find_if(
        renderer.surfaces, [](const auto& each) { return !each.asker.starts_with("picker "); });
    ASSERT_NE(asked, renderer.surfaces.end());
    const auto expected = widgets::sight_through(
        *window.session().camera().pose(), 1,
        {(picked.x() + 0.5) / view.image().width, (picked.y() + 0.5) / view.image().height});
    EXPECT_NEAR(glm::length(asked->direction - expected.direction), 0, 1e-9);
    // A drag with the right button moves the picture, as before.
    QTest::mousePress(&view, Qt::RightButton, {}, at);
    for (int x = 5; x < 30; x += 5) QTest::mouseMove(&view, at + QPoint(x, 0));
    QTest::mouseRelease(&view, Qt::RightButton, {}, at + QPoint(30, 0));
    EXPECT_EQ(QApplication::activePopupWidget(), nullptr);
    // The keyboard has a key for it.
    QContextMenuEvent key(QContextMenuEvent::Keyboard, {}, {});
    QApplication::sendEvent(&view, &key);
    ASSERT_NE(QApplication::activePopupWidget(), nullptr);
    QApplication::activePopupWidget()->close();
}

}  // namespace
}  // namespace ir::gui
