#include <gtest/gtest.h>

#include <QApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QProgressBar>
#include <QSignalSpy>
#include <QSlider>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QTest>
#include <QTreeView>
#include <QUrl>
#include <fstream>

#include "app/gui/main_window.h"
#include "projects/lock.h"
#include "renderers/core/error.h"
#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/space/layer_panel.h"

namespace ir::gui {
namespace {

TEST_F(WindowTest, StartsEmptyWithDocksAsideAndNamesTheDevice) {
    ASSERT_TRUE(settle());
    EXPECT_FALSE(window.session().has_project());
    EXPECT_FALSE(window.action("save")->isEnabled());
    EXPECT_FALSE(window.action("play")->isEnabled());
    EXPECT_FALSE(window.findChild<QDockWidget*>("buffers")->isVisible());
    EXPECT_NE(label("device").find("no device"), std::string::npos);
}

TEST_F(WindowTest, ATypedParameterIsANewPictureAndOneUndoStep) {
    open_scene();
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    type_level("0.75");
    EXPECT_FLOAT_EQ(pixel(), 0.75f);
    EXPECT_TRUE(window.isWindowModified());
    window.action("undo")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    EXPECT_FLOAT_EQ(level()->value(), 0.25f);
    window.action("redo")->trigger();
    ASSERT_TRUE(settle());
    EXPECT_FLOAT_EQ(pixel(), 0.75f);
}

TEST_F(WindowTest, ADraggedSliderIsOneUndoStep) {
    open_scene();
    auto* slider = window.findChild<QWidget*>("editor:level")->findChild<QSlider*>();
    const auto before = steps();
    slider->setSliderDown(true);
    for (int value : {300, 500, 800}) slider->setValue(value);
    slider->setSliderDown(false);
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), before + 1);
    EXPECT_FLOAT_EQ(pixel(), 0.8f);
}

TEST_F(WindowTest, AnOrbitIsOneEditOfTheCamera) {
    open_scene();
    const auto before = steps();
    for (int turn = 0; turn < 2; ++turn) {
        window.action("orbit")->trigger();
        auto& view = window.view();
        QTest::mousePress(&view, Qt::LeftButton, {}, {50, 50});
        for (int x = 55; x < 90; x += 5) QTest::mouseMove(&view, {x, 60});
        QTest::mouseRelease(&view, Qt::LeftButton, {}, {90, 60});
        ASSERT_TRUE(settle());
    }
    EXPECT_EQ(steps(), before + 2);
    ASSERT_EQ(window.session().document().cameras.size(), 1u);
    const auto& camera = window.session().document().cameras.front();
    EXPECT_EQ(window.session().experiment()->camera, camera.id);
    ASSERT_TRUE(renderer.requests.back().experiment.camera.has_value());
    EXPECT_NEAR(renderer.requests.back().experiment.camera->eye.x, camera.eye.x, 1e-5);
    window.action("undo")->trigger();
    window.action("undo")->trigger();
    EXPECT_TRUE(window.session().document().cameras.empty());
}

TEST_F(WindowTest, OffersALightWhereTheSceneHasNone) {
    renderer.scene_sources.clear();
    open_scene();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.banners().text("light").isEmpty(); }, 60000));
    const auto before = steps();
    auto* banner = window.banners().findChild<QWidget*>("banner:light");
    ASSERT_NE(banner, nullptr);
    QTest::mouseClick(banner->findChild<QPushButton*>(), Qt::LeftButton);
    ASSERT_TRUE(settle());
    EXPECT_EQ(steps(), before + 1);
    const auto& document = window.session().document();
    ASSERT_EQ(document.lights.size(), 1u);
    EXPECT_EQ(window.session().experiment()->lights, document.lights[0].id) << "applied at once";
    ASSERT_EQ(document.lights[0].lights.size(), 1u);
    EXPECT_GT(document.lights[0].lights[0].intensity(), 0);
    EXPECT_EQ(renderer.requests.back().experiment.lights.size(), 1u);
    EXPECT_TRUE(window.banners().text("light").isEmpty());
    window.action("undo")->trigger();
    EXPECT_TRUE(window.session().document().lights.empty());
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.banners().text("light").isEmpty(); }, 60000));
}

TEST_F(WindowTest, ShowsTheNotesOfTheProjectAboveTheViews) {
    open_scene();
    auto* strip = window.findChild<widgets::NotesStrip*>();
    EXPECT_TRUE(strip->isHidden());
    window.session().edit(
        [&](const projects::Project& project) { return projects::edits::set_notes(project, "Figure 9"); });
    EXPECT_FALSE(strip->isHidden());
    EXPECT_EQ(strip->isAncestorOf(window.focusWidget()), false);
}

TEST_F(WindowTest, LinkedViewsShareTheExposureThatNobodyChose) {
    open_scene();
    add_second_experiment(0.01);
    trigger("views-2");
    const auto first = window.session().experiment()->id;
    const auto other = window.session().document().experiments[1].id;
    auto states = std::array{window.views().state(0), window.views().state(1)};
    states[0].a = {first, {}};
    states[1].a = {other, {}};
    for (int view = 0; view < 2; ++view) window.views().set_state(view, states[std::size_t(view)]);
    ASSERT_TRUE(settle());
    const auto exposure = [&](int view) {
        return window.workspace().pane(view)->compare().compared().shown_display(0).exposure;
    };
    EXPECT_EQ(exposure(0), exposure(1)) << "else brightness could not be compared";
    window.views().set_linked(false);
    ASSERT_TRUE(settle());
    EXPECT_GT(exposure(1), exposure(0)) << "the darker picture by itself";
}

TEST_F(WindowTest, ChangesThatDoNotTouchThePictureRenderNothing) {
    open_scene();
    const auto count = renderer.requests.size();
    window.session().edit(
        [&](const projects::Project& project) { return projects::edits::set_notes(project, "a note"); });
    ASSERT_TRUE(settle());
    EXPECT_EQ(renderer.requests.size(), count);
    EXPECT_TRUE(window.isWindowModified());
}

TEST_F(WindowTest, AClickedBufferIsShownAndComputed) {
    open_scene();
    auto* view = window.findChild<QDockWidget*>("buffers")->findChild<QTreeView*>();
    auto* model = qobject_cast<widgets::RowsModel*>(view->model());
    const QModelIndex depth = model->index_of("depth");
    ASSERT_TRUE(depth.isValid());
    EXPECT_EQ(depth.siblingAtColumn(3).data().toString(), "not computed");
    view->scrollTo(depth);
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, view->visualRect(depth).center());
    ASSERT_TRUE(settle());
    EXPECT_EQ(renderer.requests.back().parts.front().key, "depth");
    EXPECT_EQ(window.view().image().channels, 1);
    EXPECT_EQ(window.view().picture()->semantic, Semantic::depth);
}

TEST_F(WindowTest, BuffersAreFoundByWordsOfTheirNames) {
    open_scene();
    auto* buffers = window.findChild<QDockWidget*>("buffers");
    auto* view = buffers->findChild<QTreeView*>();
    auto* model = qobject_cast<widgets::RowsModel*>(view->model());
    auto* search = buffers->findChild<QLineEdit*>("search");
    const auto is_hidden = [&](const char* key) {
        const auto row = model->index_of(key);
        return view->isRowHidden(row.row(), row.parent());
    };
    ASSERT_FALSE(is_hidden("depth"));
    QTest::mouseClick(search, Qt::LeftButton);
    QTest::keyClicks(search, "DEP");
    EXPECT_FALSE(is_hidden("depth"));
    EXPECT_TRUE(is_hidden("levels"));
    // New rows, too, are only those that are searched.
    trigger("rerun");
    EXPECT_TRUE(is_hidden("levels"));
    QTest::keyClick(search, Qt::Key_Return);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().shown_key(), "depth");
    QTest::keyClick(search, Qt::Key_Escape);
    EXPECT_FALSE(is_hidden("levels"));
    EXPECT_EQ(search->text(), "");
}

TEST_F(WindowTest, RenderingShowsProgressAndEscapeCancels) {
    open_scene();
    renderer.hold = true;
    window.action("rerun")->trigger();
    EXPECT_FALSE(window.is_settled());
    const auto before = label("state");
    for (int i = 0; i < 100; ++i)
        emit renderer.progressed(window.session().experiment()->id, "pass " + std::to_string(i), 0.004 * i);
    EXPECT_EQ(label("state"), before) << "each text draws the whole window";
    emit renderer.progressed(window.session().experiment()->id, "painting", 0.5);
    const auto* bar = window.statusBar()->findChild<QProgressBar*>();
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar->value() == 500; }, 60000));
    EXPECT_NE(label("state").find("painting"), std::string::npos);
    QTest::keyClick(&window.view(), Qt::Key_Escape);
    ASSERT_TRUE(settle());
    EXPECT_GE(renderer.cancels, 1);
    EXPECT_EQ(state(), LivePictures::State::cancelled);
    EXPECT_FALSE(window.view().image().empty());  // the last picture stays
}

TEST_F(WindowTest, TheRemainingTimeIsThatOfTheFramesThatAreMissing) {
    open_scene();
    const auto id = window.session().experiment()->id;
    renderer.hold = true;
    window.action("rerun")->trigger();
    emit renderer.progressed(id, "", 0.9);  // it goes on from there
    ASSERT_TRUE(QTest::qWaitFor(
        [&] {
            emit renderer.progressed(id, "painting", 0.925);
            return label("state").find("left") != std::string::npos;
        },
        60000))
        << label("state");
    const auto* bar = window.statusBar()->findChild<QProgressBar*>();
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar->value() == 925; }, 60000));
    const auto left = window.live().progress(id).seconds_left;
    ASSERT_TRUE(left);
    EXPECT_GE(*left, 2.9) << "three times as much is missing as has been done in a second";
    renderer.hold = false;
    window.live().cancel();
    window.live().render_again();
    ASSERT_TRUE(settle());
}

TEST_F(WindowTest, SaveAsThenReopenGivesTheSameState) {
    const QTemporaryDir folder;
    open_scene();
    type_level("0.5");
    const auto saved = window.session().document();
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    EXPECT_FALSE(window.isWindowModified());
    const auto kept = window.session().document();
    EXPECT_EQ(kept.experiments, saved.experiments);
    window.session().files().close();
    EXPECT_FALSE(window.findChild<QDockWidget*>("buffers")->isVisible());
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.session().document(), kept);
    EXPECT_FLOAT_EQ(pixel(), 0.5f);
    EXPECT_FALSE(window.isWindowModified());
}

TEST_F(WindowTest, AHeldLockOpensReadOnlyWithABanner) {
    const QTemporaryDir folder;
    const auto path = folder.path() + "/kept.interreflect";
    open_scene();
    window.session().files().save_as(path.toStdString());
    FakeRenderer other_renderer;
    MainWindow other(other_renderer, fake_registry(), {.remember = false, .surface = painted});
    other.show();
    ASSERT_TRUE(other.open_path(path));
    EXPECT_TRUE(other.banners().names().contains("read-only"));
    EXPECT_FALSE(other.findChild<QWidget*>("editor:level")->isEnabled());
    EXPECT_FALSE(other.action("save")->isEnabled());
    other.session().files().close();
}

TEST_F(WindowTest, AMissingSceneIsABannerAndTheExperimentIsKept) {
    const QTemporaryDir folder;
    const std::string scene = (folder.path() + "/room.gltf").toStdString();
    std::ofstream(scene) << R"({"asset":{"version":"2.0"}})";
    ASSERT_TRUE(window.open_path(QString::fromStdString(scene)));
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    window.session().files().close();
    std::filesystem::remove(scene);
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window.banners().names().contains("scene"));
    EXPECT_EQ(state(), LivePictures::State::blocked);
    EXPECT_EQ(window.session().document().experiments.size(), 1u);
}

TEST_F(WindowTest, ABadFileIsOneClearLineAndKeepsTheOpenProject) {
    open_scene();
    const QTemporaryDir folder;
    QDir(folder.path()).mkdir("bad.interreflect");
    std::ofstream((folder.path() + "/bad.interreflect/project.json").toStdString()) << "{ no";
    EXPECT_FALSE(window.open_path(folder.path() + "/bad.interreflect"));
    EXPECT_TRUE(window.session().has_project());
    ASSERT_TRUE(window.banners().names().contains("file"));
    const QString line = window.banners().text("file");
    EXPECT_TRUE(line.contains("project.json"));
    EXPECT_FALSE(line.contains('\n'));
    EXPECT_EQ(window.messages().model().count(Severity::error), 1);
}

TEST_F(WindowTest, AFileThatIsNoSceneIsOneClearLineAndKeepsTheOpenProject) {
    open_scene();
    const auto* before = &window.session().open_project();
    const QTemporaryDir folder;
    for (const char* name : {"junk.glb", "junk.gltf"}) {
        const QString file = folder.path() + "/" + name;
        std::ofstream(file.toStdString()) << "\x01\xff no scene at all";
        EXPECT_FALSE(window.open_path(file));
        EXPECT_EQ(&window.session().open_project(), before);
        ASSERT_TRUE(window.banners().names().contains("file"));
        const QString line = window.banners().text("file");
        EXPECT_TRUE(line.contains(name) && line.contains("no glTF")) << line.toStdString();
        EXPECT_FALSE(line.contains('\n'));
    }
}

TEST_F(WindowTest, ADroppedSceneStartsAProject) {
    const QTemporaryDir folder;
    const QString file = folder.path() + "/room.gltf";
    std::ofstream(file.toStdString()) << R"({"asset":{"version":"2.0"}})";
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(file)});
    QDragEnterEvent enter({50, 50}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &enter);
    ASSERT_TRUE(enter.isAccepted());
    QDropEvent drop(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &drop);
    ASSERT_TRUE(window.session().has_project());
    EXPECT_EQ(window.session().document().scenes.size(), 1u);
}

TEST_F(WindowTest, DocksUndockAndRedockAndTheDefaultLayoutComesBack) {
    open_scene();
    const auto docks = window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    for (auto* dock : docks) {
        dock->setFloating(true);
        QApplication::processEvents();
        EXPECT_TRUE(dock->isFloating());
        dock->setFloating(false);
        dock->hide();
    }
    window.action("layout-default")->trigger();
    QApplication::processEvents();
    const QStringList quiet{"messages", "results",    "plots",   "sweeps",   "analyses", "timeline",
                            "frames",   "benchmarks", "profile", "pipeline", "shaders"};
    for (auto* dock : docks)
        EXPECT_EQ(dock->isHidden(), quiet.contains(dock->objectName())) << dock->objectName().toStdString();
    window.action("dock-messages")->trigger();
    QApplication::processEvents();
    EXPECT_FALSE(window.findChild<QDockWidget*>("messages")->visibleRegion().isEmpty());
}

TEST_F(WindowTest, DisplayFollowsTheActiveViewIntoSpaceAndTables) {
    open_scene();
    auto* dock = qobject_cast<QStackedWidget*>(window.findChild<QDockWidget*>("display")->widget());
    ASSERT_NE(dock, nullptr);
    EXPECT_NE(qobject_cast<widgets::DisplayPanel*>(dock->currentWidget()), nullptr);
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    auto* layers = qobject_cast<widgets::LayerPanel*>(dock->currentWidget());
    ASSERT_NE(layers, nullptr);
    ASSERT_EQ(layers->layers().size(), 1u);
    EXPECT_EQ(layers->layers()[0].key, "cloud");
    auto changed = layers->layers();
    changed[0].size_px = 9;
    changed[0].opacity = 0.5f;
    emit layers->layers_chosen(changed);
    ASSERT_TRUE(settle());
    EXPECT_EQ(window.views().active_state().space.layers[0].size_px, 9);
    EXPECT_EQ(window.views().active_state().space.layers[0].opacity, 0.5f);
    EXPECT_EQ(window.workspace().active_pane().space().view().scene().layers[0].size_px, 9);
    trigger("buffer-main");
    EXPECT_NE(qobject_cast<widgets::DisplayPanel*>(dock->currentWidget()), nullptr);
}

TEST_F(WindowTest, LayoutsAreNamed) {
    open_scene();
    window.docks().apply("picture");
    EXPECT_FALSE(window.findChild<QDockWidget*>("messages")->isVisible());
    for (const char* name : {"maps", "inspect"}) {  // what it was called
        window.docks().apply(name);
        EXPECT_TRUE(window.findChild<QDockWidget*>("inspector")->isVisible());
        EXPECT_FALSE(window.findChild<QDockWidget*>("timings")->isVisible());
    }
    QStringList titles;
    for (const auto& entry : DockLayout::entries()) titles << entry.title;
    for (const char* title : {"Layered depth maps", "Photons", "Filters", "Compare", "Plots"})
        EXPECT_TRUE(titles.contains(title)) << title;
    trigger("layout-photons");
    EXPECT_TRUE(window.findChild<QDockWidget*>("timings")->isVisible());
    EXPECT_EQ(window.workspace().area().open_views().size(), 2u);
    trigger("layout-filters");
    EXPECT_GT(window.findChild<QDockWidget*>("pipeline")->height(), window.height() / 3);
    EXPECT_THROW(window.docks().apply("nonsense"), UsageError);
}

TEST_F(WindowTest, OwnLayoutsAreKeptByName) {
    open_scene();
    auto& layouts = *window.findChild<LayoutController*>();
    const auto is_shown = [this](const char* dock) {
        return window.findChild<QDockWidget*>(dock)->isVisible();
    };
    window.action("layout-compare")->trigger();
    ASSERT_EQ(window.workspace().area().open_views().size(), 2u);
    window.action("dock-results")->trigger();
    window.action("layout-keep")->trigger();
    auto* dialog = window.findChild<QInputDialog*>("layout-name");
    ASSERT_TRUE(dialog);
    dialog->setTextValue("  Mine & yours ");
    dialog->accept();
    EXPECT_EQ(layouts.names(), QStringList("Mine & yours"));
    window.action("layout-default")->trigger();
    ASSERT_FALSE(is_shown("results"));
    ASSERT_EQ(window.workspace().area().open_views().size(), 1u);
    emit layouts.menu()->aboutToShow();
    QAction* own = nullptr;
    for (auto* action : layouts.menu()->actions())
        if (action->text() == "Mine && yours") own = action;
    ASSERT_TRUE(own);
    own->trigger();
    EXPECT_TRUE(is_shown("results"));
    EXPECT_TRUE(is_shown("metrics"));
    EXPECT_FALSE(is_shown("parameters"));
    EXPECT_EQ(window.workspace().area().open_views().size(), 2u);
    layouts.remove("Mine & yours");
    EXPECT_TRUE(layouts.names().isEmpty());
}

TEST_F(WindowTest, PicturesAloneAndBack) {
    open_scene();
    auto* alone = window.action("pictures-alone");
    alone->trigger();
    for (auto* dock : window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly))
        EXPECT_FALSE(dock->isVisible()) << dock->objectName().toStdString();
    alone->trigger();
    EXPECT_TRUE(window.findChild<QDockWidget*>("parameters")->isVisible());
    EXPECT_TRUE(window.findChild<QDockWidget*>("results")->isHidden());
    alone->trigger();
    window.action("layout-compare")->trigger();
    EXPECT_FALSE(alone->isChecked()) << "a layout has panels";
    EXPECT_TRUE(window.findChild<QDockWidget*>("metrics")->isVisible());
}

TEST_F(WindowTest, KeysBringACoveredPanelForwardAndHideTheOneInFront) {
    open_scene();
    const auto* buffers = window.findChild<QDockWidget*>("buffers");
    auto* metrics = window.findChild<QDockWidget*>("metrics");
    auto* show = window.action("dock-metrics");
    const auto is_seen = [](const QDockWidget* dock) { return !dock->visibleRegion().isEmpty(); };
    const auto press = [this] {
        QTest::keyClick(&window, Qt::Key_M, Qt::ControlModifier | Qt::ShiftModifier);
        test::handle_events();
    };
    ASSERT_TRUE(settle());
    ASSERT_TRUE(is_seen(buffers));
    ASSERT_FALSE(is_seen(metrics)) << "a tab covers it";
    EXPECT_FALSE(show->isChecked());
    EXPECT_TRUE(window.action("dock-buffers")->isChecked());
    press();
    EXPECT_TRUE(is_seen(metrics));
    EXPECT_FALSE(is_seen(buffers));
    EXPECT_TRUE(show->isChecked());
    EXPECT_FALSE(window.action("dock-buffers")->isChecked());
    EXPECT_TRUE(metrics->isAncestorOf(QApplication::focusWidget()));
    press();
    EXPECT_TRUE(metrics->isHidden());
    EXPECT_FALSE(show->isChecked());
    press();
    EXPECT_TRUE(is_seen(metrics));
}

TEST_F(WindowTest, ThePictureHasHalfOfTheWindowsHeight) {
    window.resize(1440, 900);
    open_scene();
    window.action("layout-default")->trigger();
    test::handle_events();
    EXPECT_EQ(window.height(), 900);
    EXPECT_GE(window.workspace().area().height(), window.height() / 2);
    window.findChild<QDockWidget*>("plots")->raise();
    test::handle_events();
    EXPECT_GE(window.workspace().area().height(), window.height() / 2);
}

TEST_F(WindowTest, KeysOfTheWindowWorkWhileANumberFieldHasTheFocus) {
    open_scene();
    QTest::mouseMove(&window.view(), window.view().rect().center());
    type_level("0.75");
    ASSERT_TRUE(level()->hasFocus());
    QTest::keyClick(level(), Qt::Key_P);
    projects::Json memory;
    window.inspector().save(memory);
    EXPECT_EQ(memory["pins"].size(), 1u);
    QTest::keyClick(level(), Qt::Key_E);  // a letter of 1e-3
    EXPECT_TRUE(level()->text().contains(QLatin1Char('e'))) << level()->text().toStdString();
    EXPECT_FLOAT_EQ(level()->value(), 0.75f);
}

TEST_F(WindowTest, AToolSaysHowItIsUsedUntilItWasAndGoesWithTheProject) {
    open_scene();
    trigger("line");
    EXPECT_TRUE(window.view().state().hint.startsWith("Line")) << window.view().state().hint.toStdString();
    window.view().setFocus();
    QTest::keyClick(&window.view(), Qt::Key_Right);  // draws one
    QTest::keyClick(&window.view(), Qt::Key_Escape);
    EXPECT_EQ(window.view().state().hint, QString());
    trigger("inspect");
    trigger("line");
    EXPECT_EQ(window.view().state().hint, QString()) << "it is known";
    trigger("rectangle");
    EXPECT_TRUE(window.view().state().hint.startsWith("Rectangle"));
    ASSERT_TRUE(window.open_path("builtin:plane"));
    ASSERT_TRUE(settle());
    EXPECT_TRUE(window.action("inspect")->isChecked());
    EXPECT_EQ(window.view().tool(), widgets::ImageView::Tool::inspect);
}

}  // namespace
}  // namespace ir::gui
