#include <QCheckBox>
#include <QDockWidget>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <future>
#include <utility>

#include "app/gui/dialog_folder.h"
#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "tests/fake_tev.h"
#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"
#include "tests/unit/scarce_disk.h"

namespace ir::gui {
namespace {

class InspectWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        window.workspace().active_pane().compare().active_view().look_at({15, 10}, 8);  // a pixel can be hit
    }
    /// A dock that stands behind a tab comes to the front.
    void raise(const char* name) {
        auto* dock = window.findChild<QDockWidget*>(name);
        dock->show();
        dock->raise();
        ASSERT_TRUE(QTest::qWaitFor([&] { return window.docks().is_seen(name); }));
    }
    QPoint place_of(QPoint pixel) {
        auto& view = window.view();
        const QPointF device = view.transform().view_from_pixel(pixel);
        return (device / view.devicePixelRatioF()).toPoint();
    }
    void move_to(QPoint pixel) {
        QTest::mouseMove(&window.view(), place_of(pixel) + QPoint(1, 1));
        QTest::mouseMove(&window.view(), place_of(pixel));
    }
    /// The screen may tell late where the cursor was before.
    void pin(QPoint pixel) {
        const auto before = window.inspector().pins().size();
        EXPECT_TRUE(QTest::qWaitFor([&] {
            move_to(pixel);
            QTest::keyClick(&window.view(), Qt::Key_P);
            return window.inspector().pins().size() > before;
        }));
    }
};

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
    QTest::keyClick(&window.view(), Qt::Key_Z);
    EXPECT_TRUE(window.view().display().zebra);
    QTest::keyClick(&window.view(), Qt::Key_M);
    EXPECT_FALSE(window.view().display().mark_bad);
    QTest::keyClick(&window.view(), Qt::Key_M);
    EXPECT_TRUE(window.view().display().mark_bad);
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

/// What a pixel shows is a chair.
class SurfaceWindowTest : public InspectWindowTest {
  protected:
    void SetUp() override {
        InspectWindowTest::SetUp();
        renderer.surface->part = 0;
        renderer.surface->node = 3;
        renderer.surface->object = "Chair";
        renderer.surface->material = "oak & ash";
        window.docks().raise("parameters");
    }
    void click(QPoint pixel, Qt::MouseButton button = Qt::LeftButton) {
        QTest::mouseClick(&window.view(), button, {}, place_of(pixel));
    }
    std::string surface_text() {
        auto* label = window.inspector().panel().findChild<QLabel*>("surface");
        return label->isVisible() ? label->text().toStdString() : "";
    }
    template <class Widget = QComboBox>
    Widget* field(const char* name) {
        for (auto* found : window.document().editor().findChildren<Widget*>(name))
            if (found->isVisible()) return found;
        return nullptr;
    }
    bool shows(const char* material) {
        return QTest::qWaitFor(
            [&] { return field("material") && field("material")->currentText() == material; });
    }
    std::string selected() { return window.document().tree().selected().key().toStdString(); }
    const projects::Scene& scene() { return window.session().document().scenes.at(0); }
};

TEST_F(SurfaceWindowTest, TheMenuOfAPictureLeadsToTheMaterialThatWasClicked) {
    click({12, 7}, Qt::RightButton);
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(menu, nullptr);
    auto* edit = window.action("edit-material");
    EXPECT_TRUE(menu->actions().contains(edit));
    EXPECT_TRUE(menu->actions().contains(window.action("edit-object")));
    EXPECT_TRUE(QTest::qWaitFor([&] { return edit->text() == "Edit &material “oak && ash” …"; }))
        << edit->text().toStdString();
    EXPECT_EQ(window.action("edit-object")->text(), "Edit &object “Chair” …");
    menu->close();
    const auto asked = renderer.surfaces.size();
    trigger("edit-material");
    EXPECT_EQ(renderer.surfaces.size(), asked) << "it is known already";
    EXPECT_TRUE(window.docks().is_seen("project"));
    ASSERT_TRUE(shows("oak & ash"));
    EXPECT_TRUE(field("material")->hasFocus());
    EXPECT_EQ(selected(), "part:" + scene().id + ":0");
    const auto before = steps();
    auto* tick = field<QCheckBox>("tick:roughness");
    ASSERT_TRUE(tick);
    tick->click();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(scene().parts[0].materials.at("oak & ash").roughness);
    EXPECT_EQ(steps(), before + 1);
    trigger("undo");
    EXPECT_TRUE(scene().parts[0].materials.empty());
    EXPECT_TRUE(shows("oak & ash"));
}

TEST_F(SurfaceWindowTest, AKeyLeadsToTheObjectUnderTheCursor) {
    EXPECT_TRUE(QTest::qWaitFor([&] {
        move_to({12, 7});
        return window.inspector().pointed().x() >= 0;
    }));
    QTest::keyClick(&window.view(), Qt::Key_O, Qt::ShiftModifier);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.docks().is_seen("project"); }));
    auto* place = field<QWidget>("translation");
    ASSERT_TRUE(place);
    EXPECT_TRUE(QTest::qWaitFor([&] { return place->isAncestorOf(QApplication::focusWidget()); }));
    EXPECT_FALSE(place->visibleRegion().isEmpty());
    EXPECT_EQ(selected(), "part:" + scene().id + ":0");
}

TEST_F(SurfaceWindowTest, TheFormTakesWhatIsClickedNext) {
    window.docks().raise("project");
    window.document().select({widgets::ItemKind::scene, QString::fromStdString(scene().id)});
    ASSERT_TRUE(field("material"));
    EXPECT_NE(field("material")->currentText(), "oak & ash");
    auto* pick = field<QToolButton>("pick-material");
    ASSERT_TRUE(pick);
    pick->click();
    EXPECT_TRUE(pick->isChecked());
    click({12, 7});
    ASSERT_TRUE(shows("oak & ash"));
    EXPECT_FALSE(pick->isChecked());
    renderer.surface->material = "steel";
    click({3, 7});
    test::handle_events();
    EXPECT_TRUE(shows("oak & ash")) << "one click was waited for";
    pick->click();
    pick->click();
    click({4, 7});
    test::handle_events();
    EXPECT_TRUE(shows("oak & ash")) << "none is waited for any longer";
}

TEST_F(SurfaceWindowTest, WithoutASurfaceTheMenuSaysSo) {
    auto* edit = window.action("edit-material");
    EXPECT_FALSE(edit->isEnabled()) << "no pixel is pointed at";
    EXPECT_TRUE(why_disabled(*edit).contains("Point at a surface"));
    renderer.surface.reset();
    click({12, 7}, Qt::RightButton);
    ASSERT_TRUE(QApplication::activePopupWidget());
    EXPECT_TRUE(QTest::qWaitFor([&] { return !edit->isEnabled(); }));
    EXPECT_TRUE(why_disabled(*edit).contains("no surface under the cursor"));
    EXPECT_EQ(edit->text(), "Edit &material …");
    EXPECT_FALSE(window.action("edit-object")->isEnabled());
    QApplication::activePopupWidget()->close();
}

TEST_F(SurfaceWindowTest, TheInspectorTellsMaterialAndObjectOfThePickedPixel) {
    raise("buffers");
    ASSERT_FALSE(window.docks().is_seen("inspector"));
    click({12, 7});
    test::handle_events();
    for (const auto& each : renderer.surfaces)
        EXPECT_FALSE(each.asker.starts_with("picker ")) << each.asker << ", and nobody looks";
    raise("inspector");
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return surface_text() == "Pixel 12, 7: material “oak & ash” of object “Chair”";
    })) << surface_text();
    renderer.surface->object.clear();
    click({13, 7});
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return surface_text() == "Pixel 13, 7: material “oak & ash” of object “node 3”";
    })) << surface_text();
    renderer.surface.reset();
    click({14, 7});
    EXPECT_TRUE(QTest::qWaitFor([&] { return surface_text() == "Pixel 14, 7: no surface"; }));
    auto pose = *window.session().camera().pose();
    pose.eye.x += 1;
    const auto asked = renderer.surfaces.size();
    window.session().camera().move(window.session().experiment()->id, pose, {});
    window.session().camera().finish_move();
    ASSERT_TRUE(settle());
    EXPECT_EQ(surface_text(), "") << "another place is seen there";
    EXPECT_EQ(renderer.surfaces.size(), asked);
}

}  // namespace
}  // namespace ir::gui
