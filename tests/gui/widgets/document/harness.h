#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QSplitter>
#include <QTest>

#include "projects/undo_stack.h"
#include "widgets/document/fields.h"
#include "widgets/document/item_editor.h"
#include "widgets/document/project_model.h"
#include "widgets/document/project_panel.h"
#include "widgets/document/project_tree.h"

namespace ir::widgets {

/// Two methods, as a build would register them.
const Registry& sample_registry();
/// Two scenes, two cameras, two sets of lights, two experiments, a comparison, an image, a motion, a sweep,
/// a plot.
projects::Project sample_project();

/// Panel and editor on a document with undo, as a window has them.
class DocumentTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto apply = [this](const EditMaker& make) {
            try {
                if (stack.push(project, make(project))) show();
            } catch (const std::exception& error) {
                message = error.what();
            }
        };
        const auto end = [this] { stack.end_gesture(); };
        QObject::connect(panel, &ProjectPanel::edit_wanted, panel, apply);
        QObject::connect(panel, &ProjectPanel::gesture_finished, panel, end);
        QObject::connect(editor, &ItemEditor::edit_wanted, editor, apply);
        QObject::connect(editor, &ItemEditor::gesture_finished, editor, end);
        QObject::connect(panel, &ProjectPanel::item_selected, editor, &ItemEditor::show_item);
        editor->set_comparison_modes({{"wipe", "Wipe", {}}, {"difference", "Difference", {}}});
        show();
        window.addWidget(panel);
        window.addWidget(editor);
        window.resize(330, 1000);
        window.setSizes({360, 640});
        window.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
        QApplication::setActiveWindow(&window);
    }
    void show() {
        panel->set_project(project, sample_registry(), read_only, "Another program has it open.");
        editor->set_project(project, sample_registry(), read_only, "Another program has it open.");
    }
    void undo() {
        stack.undo(project);
        show();
    }
    /// Selects by key, "camera:nave", and gives the tree the focus.
    void select(const char* key) {
        panel->select(ItemRef::from_key(QString::fromLatin1(key)));
        tree->setFocus();
    }
    template <class Widget>
    Widget* field(const char* name) {
        // The stack holds all editors; only the one that is shown counts.
        for (auto* found : editor->findChildren<Widget*>(QString::fromLatin1(name)))
            if (found->isVisible()) return found;
        ADD_FAILURE() << "no visible field " << name;
        return nullptr;
    }
    void type_number(const char* name, const char* text) {
        auto* number = field<NumberField>(name);
        number->setFocus();
        number->selectAll();
        QTest::keyClicks(number, text);
        QTest::keyClick(number, Qt::Key_Return);
    }
    void type_text(const char* name, const char* text) {
        auto* line = field<QLineEdit>(name);
        line->setFocus();
        line->selectAll();
        QTest::keyClick(line, Qt::Key_Backspace);
        QTest::keyClicks(line, text);
        QTest::keyClick(line, Qt::Key_Return);
    }
    void choose(const char* name, const char* id) {
        auto* box = field<QComboBox>(name);
        box->setCurrentIndex(box->findData(QString::fromLatin1(id)));
        emit box->activated(box->currentIndex());
    }
    void key(Qt::Key code, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
        QTest::keyClick(tree, code, modifiers);
        QApplication::processEvents();
    }
    std::size_t steps() const { return stack.position(); }

    projects::Project project = sample_project();
    projects::UndoStack stack;
    QString message;
    bool read_only = false;
    QSplitter window{Qt::Vertical};
    ProjectPanel* panel = new ProjectPanel;
    ItemEditor* editor = new ItemEditor;
    ProjectTree* tree = panel->view();
};

}  // namespace ir::widgets
