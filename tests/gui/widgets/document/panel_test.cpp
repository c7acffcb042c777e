#include <QAction>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QSignalSpy>
#include <QToolButton>

#include "tests/gui/widgets/document/harness.h"
#include "widgets/document/makers.h"

namespace ir::widgets {
namespace {

class DocumentPanelTest : public DocumentTest {
  protected:
    QToolButton* button(const char* name) {
        return panel->findChild<QToolButton*>(QStringLiteral("button:") + QLatin1String(name));
    }
    QLineEdit* name_editor() { return tree->findChild<QLineEdit*>(); }
    void type_name(const char* name) {
        ASSERT_TRUE(name_editor());
        name_editor()->selectAll();
        QTest::keyClick(name_editor(), Qt::Key_Backspace);
        QTest::keyClicks(name_editor(), name);
        QTest::keyClick(name_editor(), Qt::Key_Return);
        QApplication::processEvents();  // the view takes the text once the key is done
    }
};

TEST_F(DocumentPanelTest, F2RenamesInPlace) {
    select("camera:nave");
    key(Qt::Key_F2);
    type_name("Choir");
    EXPECT_EQ(project.cameras[0].name, "Choir");
    EXPECT_EQ(project.cameras[0].id, "nave");
    EXPECT_EQ(panel->selected().key(), "camera:nave");
    undo();
    EXPECT_EQ(project.cameras[0].name, "Nave");
}

TEST_F(DocumentPanelTest, AnEmptyNameIsRefused) {
    select("camera:nave");
    key(Qt::Key_F2);
    type_name("");
    EXPECT_EQ(project.cameras[0].name, "Nave");
    EXPECT_TRUE(message.contains("needs a name")) << message.toStdString();
}

TEST_F(DocumentPanelTest, TheProjectIsRenamedToo) {
    select("project");
    QTest::mouseClick(button("rename"), Qt::LeftButton);
    type_name("Figure 8");
    EXPECT_EQ(project.name, "Figure 8");
}

TEST_F(DocumentPanelTest, DeletionThatOthersNeedIsRefusedWithTheirNames) {
    select("camera:nave");
    key(Qt::Key_Delete);
    EXPECT_EQ(project.cameras.size(), 2u);
    for (const char* user : {"Layers", "Paths", "Walk"})
        EXPECT_TRUE(message.contains(user)) << message.toStdString();
}

TEST_F(DocumentPanelTest, DeleteTakesTheItemAndSelectsItsNeighbour) {
    select("camera:from-file");
    key(Qt::Key_Delete);
    ASSERT_EQ(project.cameras.size(), 1u);
    EXPECT_EQ(panel->selected().key(), "camera:nave");
    undo();
    EXPECT_EQ(project.cameras.size(), 2u);
    EXPECT_EQ(project.cameras[1].id, "from-file");
}

TEST_F(DocumentPanelTest, DuplicateSelectsTheCopy) {
    for (const char* item : {"camera:nave", "scene:yard", "lights:evening", "experiment:layers",
                             "comparison:both", "image:photo", "sweep:sizes", "plot:error", "motion:walk"}) {
        const projects::Project before = project;
        select(item);
        key(Qt::Key_D, Qt::ControlModifier);
        EXPECT_NE(panel->selected().key(), item);
        EXPECT_EQ(panel->selected().kind, ItemRef::from_key(item).kind);
        EXPECT_EQ(editor->item(), panel->selected());
        EXPECT_NE(project, before) << item;
        undo();
        EXPECT_EQ(project, before) << item;
    }
}

TEST_F(DocumentPanelTest, AltArrowsReorder) {
    select("experiment:layers");
    key(Qt::Key_Down, Qt::AltModifier);
    EXPECT_EQ(project.experiments[1].id, "layers");
    EXPECT_EQ(panel->selected().key(), "experiment:layers");
    EXPECT_FALSE(button("down")->isEnabled());
    EXPECT_TRUE(button("down")->toolTip().contains("last"));
    key(Qt::Key_Up, Qt::AltModifier);
    EXPECT_EQ(project.experiments[0].id, "layers");
    EXPECT_EQ(steps(), 2u);
}

TEST_F(DocumentPanelTest, SingleLightsAndFilesAreItemsToo) {
    select("light:evening:0");
    key(Qt::Key_Down, Qt::AltModifier);
    EXPECT_EQ(project.lights[0].lights[1].type, projects::LightSpec::Type::spot);
    EXPECT_EQ(panel->selected().key(), "light:evening:1");
    key(Qt::Key_D, Qt::ControlModifier);
    EXPECT_EQ(project.lights[0].lights.size(), 3u);
    EXPECT_EQ(panel->selected().key(), "light:evening:2");
    key(Qt::Key_Delete);
    EXPECT_EQ(project.lights[0].lights.size(), 2u);
    select("part:yard:1");
    key(Qt::Key_Delete);
    EXPECT_EQ(project.scenes[1].parts.size(), 1u);
    EXPECT_EQ(panel->selected().key(), "part:yard:0");
    key(Qt::Key_Delete);
    EXPECT_EQ(project.scenes[1].parts.size(), 1u);
    EXPECT_TRUE(button("remove")->toolTip().contains("at least one file"));
}

TEST_F(DocumentPanelTest, DragsReorder) {
    const QModelIndex from = panel->model().index_of({ItemKind::scene, "yard"});
    const std::unique_ptr<QMimeData> data(panel->model().mimeData({from}));
    const QModelIndex scenes = panel->model().group_index(ItemKind::scene);
    ASSERT_TRUE(panel->model().dropMimeData(data.get(), Qt::MoveAction, 0, 0, scenes));
    QApplication::processEvents();
    EXPECT_EQ(project.scenes[0].id, "yard");
    undo();
    EXPECT_EQ(project.scenes[0].id, "atrium");
}

TEST_F(DocumentPanelTest, TheFilterKeepsWhatMatches) {
    auto* line = panel->findChild<QLineEdit*>("project-filter");
    QTest::keyClicks(line, "gallery");
    const QAbstractItemModel& shown = *tree->model();
    ASSERT_EQ(shown.rowCount(), 1);
    EXPECT_EQ(shown.index(0, 0).data().toString(), "Cameras");
    ASSERT_EQ(shown.rowCount(shown.index(0, 0)), 1);
    EXPECT_EQ(shown.index(0, 0, shown.index(0, 0)).data().toString(), "Gallery");
    line->clear();
    EXPECT_GT(shown.rowCount(), 5);
}

TEST_F(DocumentPanelTest, ReturnActivates) {
    QSignalSpy activated(panel, &ProjectPanel::item_activated);
    select("experiment:paths");
    key(Qt::Key_Return);
    ASSERT_EQ(activated.count(), 1);
    EXPECT_EQ(activated[0][0].value<ItemRef>().key(), "experiment:paths");
}

TEST_F(DocumentPanelTest, AClickSelects) {
    QSignalSpy chosen(panel, &ProjectPanel::item_selected);
    const QModelIndex proxy = tree->model()->index(0, 0);
    QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualRect(proxy).center());
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].value<ItemRef>().kind, ItemKind::project);
}

TEST_F(DocumentPanelTest, AddsWhatNeedsNoDialogAndAsksForTheRest) {
    QSignalSpy wanted(panel, &ProjectPanel::add_wanted);
    select("lights:evening");
    auto* menu = panel->findChild<QMenu*>();
    key(Qt::Key_Insert);
    QTRY_VERIFY_WITH_TIMEOUT(menu->isVisible(), 2000);
    const auto trigger = [&](const QString& text) {
        for (auto* action : menu->actions())
            if (action->text() == text) return action->trigger();
        ADD_FAILURE() << text.toStdString();
    };
    trigger("Set of lights");
    EXPECT_EQ(project.lights.size(), 3u);
    EXPECT_EQ(panel->selected().key(), "lights:" + QString::fromStdString(project.lights[2].id));
    trigger("Comparison");
    EXPECT_EQ(project.comparisons.size(), 2u);
    trigger("Camera from the view");
    ASSERT_EQ(wanted.count(), 1);
    EXPECT_EQ(wanted[0][0].value<ItemKind>(), ItemKind::camera);
    menu->hide();
    select("lights:evening");
    key(Qt::Key_Insert);
    trigger("Point light to this set");
    EXPECT_EQ(project.lights[0].lights.size(), 3u);
    EXPECT_EQ(panel->selected().key(), "light:evening:2");
    menu->hide();
}

TEST_F(DocumentPanelTest, BookmarksAreNumbered) {
    CameraPose pose;
    pose.eye = {1, 2, 3};
    emit panel->edit_wanted(makers::add_camera(pose));
    emit panel->edit_wanted(makers::add_camera(pose));
    ASSERT_EQ(project.cameras.size(), 4u);
    EXPECT_EQ(project.cameras[2].name, "View 1");
    EXPECT_EQ(project.cameras[3].name, "View 2");
    EXPECT_EQ(project.cameras[3].eye, glm::dvec3(1, 2, 3));
}

TEST_F(DocumentPanelTest, FoldingStays) {
    const auto scenes = [&] {
        for (int row = 0; row < tree->model()->rowCount(); ++row)
            if (tree->model()->index(row, 0).data() == "Scenes") return tree->model()->index(row, 0);
        return QModelIndex();
    };
    EXPECT_TRUE(tree->isExpanded(scenes()));
    tree->setExpanded(scenes(), false);
    select("camera:from-file");
    key(Qt::Key_Delete);
    EXPECT_FALSE(tree->isExpanded(scenes()));
    EXPECT_TRUE(scenes().isValid());
}

TEST_F(DocumentPanelTest, ReadOnlyProjectsSayWhy) {
    read_only = true;
    show();
    select("camera:nave");
    for (const char* name : {"add", "duplicate", "rename", "up", "down", "remove"}) {
        EXPECT_FALSE(button(name)->isEnabled()) << name;
        EXPECT_TRUE(button(name)->toolTip().contains("Another program has it open.")) << name;
    }
    const projects::Project before = project;
    key(Qt::Key_Delete);
    key(Qt::Key_D, Qt::ControlModifier);
    key(Qt::Key_F2);
    EXPECT_FALSE(name_editor());
    EXPECT_EQ(project, before);
}

TEST_F(DocumentPanelTest, ItsKeysGoBeforeTheWindows) {
    QAction own(&window);
    own.setShortcut(QKeySequence(Qt::CTRL | Qt::Key_D));
    window.addAction(&own);
    QSignalSpy triggered(&own, &QAction::triggered);
    select("camera:nave");
    key(Qt::Key_D, Qt::ControlModifier);
    EXPECT_EQ(project.cameras.size(), 3u);
    EXPECT_EQ(triggered.count(), 0);
}

}  // namespace
}  // namespace ir::widgets
