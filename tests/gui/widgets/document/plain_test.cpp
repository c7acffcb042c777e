#include <QCheckBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSignalSpy>
#include <QToolButton>

#include "tests/gui/widgets/document/harness.h"

namespace ir::widgets {
namespace {

class EditorTest : public DocumentTest {
  protected:
    void type_notes(const char* text) {
        auto* notes = field<NotesField>("notes");
        notes->setFocus();
        QTest::keyClicks(notes, text);
        tree->setFocus();  // leaving takes them over
    }
};

TEST_F(EditorTest, TheProjectHasANameAndNotes) {
    select("project");
    type_text("name", "Figure 9");
    EXPECT_EQ(project.name, "Figure 9");
    type_notes("Why");
    EXPECT_EQ(project.notes, "Why");
    undo();
    EXPECT_EQ(project.notes, "");
    EXPECT_EQ(field<NotesField>("notes")->toPlainText(), "");
    undo();
    EXPECT_EQ(project.name, "Figure 7");
}

TEST_F(EditorTest, NotesAreTakenWhileTypedAndGiveOneStep) {
    select("experiment:layers");
    auto* notes = field<NotesField>("notes");
    notes->setFocus();
    QTest::keyClicks(notes, "first ");
    QTRY_VERIFY_WITH_TIMEOUT(project.experiments[0].notes == "first ", 3000);
    QTest::keyClicks(notes, "second");
    QTRY_VERIFY_WITH_TIMEOUT(project.experiments[0].notes == "first second", 3000);
    EXPECT_EQ(notes->textCursor().position(), 12);
    EXPECT_EQ(steps(), 1u);
    undo();
    EXPECT_EQ(project.experiments[0].notes, "");
}

TEST_F(EditorTest, WhatIsBeingTypedStaysWithItsItem) {
    select("experiment:layers");
    auto* notes = field<NotesField>("notes");
    notes->setFocus();
    QTest::keyClicks(notes, "about layers");
    editor->show_item({ItemKind::experiment, "paths"});
    EXPECT_EQ(project.experiments[0].notes, "about layers");
    EXPECT_EQ(project.experiments[1].notes, "");
    EXPECT_EQ(field<NotesField>("notes")->toPlainText(), "");
}

TEST_F(EditorTest, ClearForgetsWhatIsBeingTyped) {
    select("experiment:layers");
    auto* notes = field<NotesField>("notes");
    notes->setFocus();
    QTest::keyClicks(notes, "of the old project");
    editor->clear();
    show();
    // Notes that are typed later are taken over later.
    NotesField other("other", nullptr);
    QSignalSpy taken(&other, &NotesField::chosen);
    other.show();
    QTest::keyClicks(&other, "typed now");
    ASSERT_TRUE(taken.wait(5000));
    EXPECT_EQ(project, sample_project());
}

TEST_F(EditorTest, CommitTakesWhatIsBeingTyped) {
    select("camera:nave");
    auto* fov = field<NumberField>("fov_y_degrees");
    fov->setFocus();
    fov->selectAll();
    QTest::keyClicks(fov, "33");
    EXPECT_EQ(project.cameras[0].fov_y_degrees, 45);
    editor->commit();
    EXPECT_EQ(project.cameras[0].fov_y_degrees, 33);
}

TEST_F(EditorTest, ExperimentsChooseSceneCameraLightsAndReference) {
    select("experiment:layers");
    choose("scene", "atrium");
    EXPECT_EQ(project.experiments[0].scene, "atrium");
    choose("camera", "");
    EXPECT_EQ(project.experiments[0].camera, "");
    choose("lights", "scene");
    EXPECT_EQ(project.experiments[0].lights, "scene");
    choose("reference", "");
    EXPECT_EQ(project.experiments[0].reference, "");
    EXPECT_EQ(field<QComboBox>("reference")->findData("layers"), -1);  // never its own
    EXPECT_EQ(steps(), 4u);
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(EditorTest, ComparisonsAreEditedByValues) {
    select("comparison:both");
    const auto& comparison = project.comparisons[0];
    choose("b", "photo");
    EXPECT_EQ(comparison.b, "photo");
    choose("output", "normals");
    EXPECT_EQ(comparison.output, "normals");
    choose("mode", "difference");
    EXPECT_EQ(comparison.mode, "difference");
    EXPECT_FALSE(field<NumberField>("range.to")->isEnabled());
    QTest::mouseClick(field<QCheckBox>("automatic-range"), Qt::LeftButton, {}, {6, 8});
    ASSERT_TRUE(comparison.range);
    type_number("range.to", "0.25");
    EXPECT_EQ(comparison.range, glm::dvec2(0, 0.25));
    type_text("name", "Against the photograph");
    EXPECT_EQ(comparison.name, "Against the photograph");
    type_notes("Note the corner.");
    EXPECT_EQ(comparison.notes, "Note the corner.");
    while (stack.can_undo()) undo();
    EXPECT_EQ(project, sample_project());
}

TEST_F(EditorTest, ChoicesThatAreGoneAreShownAsTheyAre) {
    project.comparisons[0].a = "lost";
    project.comparisons[0].mode = "holograph";
    show();
    select("comparison:both");
    EXPECT_EQ(field<QComboBox>("a")->currentText(), "lost (not found)");
    EXPECT_EQ(field<QComboBox>("mode")->currentData().toString(), "holograph");
    EXPECT_EQ(steps(), 0u);
}

TEST_F(EditorTest, ForeignImagesHaveAFileAndNotes) {
    select("image:photo");
    project.images[0].content_hash = "abc";
    type_text("file", "images/other.exr");
    EXPECT_EQ(project.images[0].source, "images/other.exr");
    EXPECT_EQ(project.images[0].content_hash, "");
    type_notes("One bounce.");
    EXPECT_EQ(project.images[0].notes, "One bounce.");
    QSignalSpy browse(editor, &ItemEditor::browse_wanted);
    QTest::mouseClick(field<QToolButton>("browse"), Qt::LeftButton);
    ASSERT_EQ(browse.count(), 1);
    EXPECT_EQ(browse[0][0].value<ItemRef>(), (ItemRef{ItemKind::image, "photo"}));
    type_text("file", "");
    EXPECT_TRUE(message.contains("source is missing")) << message.toStdString();
    EXPECT_EQ(field<QLineEdit>("file")->text(), "images/other.exr");
}

TEST_F(EditorTest, ItemsThatAreGoneAreNotShown) {
    select("camera:from-file");
    editor->show_item({ItemKind::camera, "from-file"});
    project.cameras.pop_back();
    editor->set_project(project, sample_registry(), false, {});
    for (auto* shown : editor->findChildren<QLineEdit*>()) EXPECT_FALSE(shown->isVisible());
    editor->clear();
    panel->clear();
    EXPECT_EQ(panel->model().rowCount(), 0);
}

TEST_F(EditorTest, EveryItemOfTheSampleCanBeShownAndFitsANarrowDock) {
    for (const ItemRef& item : panel->model().items()) {
        panel->select(item);
        QApplication::processEvents();
        EXPECT_EQ(editor->item(), item);
        for (auto* control : editor->findChildren<QWidget*>()) {
            if (!control->isVisible() || control->objectName().isEmpty()) continue;
            const int right = control->mapTo(editor, QPoint(control->width(), 0)).x();
            EXPECT_LE(right, editor->width())
                << item.key().toStdString() << " " << control->objectName().toStdString();
        }
    }
    EXPECT_EQ(steps(), 0u) << "showing is no edit";
}

TEST_F(EditorTest, EveryControlHasATooltipAndAName) {
    for (const ItemRef& item : panel->model().items()) {
        panel->select(item);
        for (const char* type :
             {"ir::widgets::TextField", "ir::widgets::NotesField", "ir::widgets::ChoiceField",
              "ir::widgets::VectorField", "QToolButton", "QCheckBox"})
            for (auto* control : editor->findChildren<QWidget*>()) {
                if (!control->inherits(type) || !control->isVisible()) continue;
                if (control->objectName().isEmpty()) continue;  // section headers say it in their text
                QString tip = control->toolTip();
                for (auto* owner = control->parentWidget(); tip.isEmpty() && owner != editor;
                     owner = owner->parentWidget())
                    tip = owner->toolTip();
                EXPECT_FALSE(tip.isEmpty())
                    << item.key().toStdString() << " " << control->objectName().toStdString();
            }
    }
}

}  // namespace
}  // namespace ir::widgets
