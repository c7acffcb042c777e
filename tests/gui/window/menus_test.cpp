// Menus of the window: keys, letters, words.
#include <QMenu>
#include <QMenuBar>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

/// Entries of a menu and of its submenus that have the letter of one before them.
QStringList shared_letters(QMenu& menu) {
    emit menu.aboutToShow();
    QStringList shared;
    QHash<QString, QString> texts;
    for (const auto* action : menu.actions()) {
        if (!action->isVisible()) continue;
        const auto letter = QKeySequence::mnemonic(action->text()).toString();
        if (!letter.isEmpty() && texts.contains(letter))
            shared << menu.title() + ": " + texts[letter] + " and " + action->text();
        texts[letter] = action->text();
        if (auto* submenu = action->menu()) shared << shared_letters(*submenu);
    }
    return shared;
}

class MenusTest : public WindowTest {};

TEST_F(MenusTest, EveryMenuEntryHasKeysExceptAbout) {
    for (auto* action : window.actions())
        EXPECT_EQ(action->shortcut().isEmpty(), action->objectName() == "about")
            << action->objectName().toStdString();
    QSet<QString> seen;
    for (auto* action : window.actions())
        for (const auto& key : action->shortcuts()) {
            EXPECT_FALSE(seen.contains(key.toString())) << key.toString().toStdString();
            seen.insert(key.toString());
        }
}

TEST_F(MenusTest, NoTwoEntriesOfAMenuShareALetter) {
    const auto shared = [this] {
        QStringList all;
        QSet<QString> titles;
        for (const auto* action : window.menuBar()->actions()) {
            const auto letter = QKeySequence::mnemonic(action->text()).toString();
            if (letter.isEmpty() || titles.contains(letter)) all << action->text();
            titles.insert(letter);
            if (action->menu()) all << shared_letters(*action->menu());
        }
        for (auto* menu : window.findChildren<QMenu*>())  // of the picture and of the experiment
            if (menu->title().isEmpty()) all << shared_letters(*menu);
        return all.join('\n').toStdString();
    };
    EXPECT_EQ(shared(), "");
    open_scene();
    add_second_experiment(0.75);  // there is something to undo
    EXPECT_EQ(shared(), "");
}

TEST_F(MenusTest, UndoNamesWhatItTakesBackInTheWindowsQuotes) {
    open_scene();
    window.session().edit([](const projects::Project& project) {
        projects::Camera camera;
        camera.id = "oak";
        camera.name = "Oak & Ash's";
        return projects::edits::add(project, camera);
    });
    EXPECT_EQ(window.action("undo")->text().toStdString(), "&Undo: Add camera “Oak && Ash's”");
    trigger("undo");
    EXPECT_EQ(window.action("redo")->text().toStdString(), "&Redo: Add camera “Oak && Ash's”");
}

}  // namespace
}  // namespace ir::gui
