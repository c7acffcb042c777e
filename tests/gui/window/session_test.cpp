#include <QDialog>
#include <QFileDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTimer>
#include <fstream>

#include "renderers/core/error.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;

struct SessionTest : WindowTest {
    Session& session() { return window.session(); }
    const projects::UndoStack& steps() { return session().open_project().undo_stack(); }
    void set_notes(const char* notes) {
        session().edit(
            [&](const projects::Project& project) { return projects::edits::set_notes(project, notes); });
        session().end_gesture();
    }
    /// Does `work` while the file dialog is open, then chooses the file in it.
    void when_asked_for_a_file(const QString& file, const std::function<void()>& work) {
        QTimer::singleShot(300, &window, [this, file, work] {
            auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
            ASSERT_NE(dialog, nullptr);
            work();
            dialog->findChild<QLineEdit*>("fileNameEdit")->setText(file);
            static_cast<QDialog*>(dialog)->accept();
        });
    }
    QTemporaryDir temporary;
    fs::path root = temporary.path().toStdString();
    fs::path folder = root / "a.interreflect";
};

TEST_F(SessionTest, WhatASceneBeginsWithCannotBeUndoneAndIsNotSaved) {
    open_scene();
    EXPECT_EQ(session().document().name, "cornell");
    ASSERT_NE(session().experiment(), nullptr);
    EXPECT_FALSE(steps().can_undo());
    EXPECT_FALSE(window.action("undo")->isEnabled());
    EXPECT_TRUE(session().open_project().is_dirty());
    set_notes("x");
    session().undo();
    EXPECT_FALSE(steps().can_undo());
    EXPECT_NE(session().experiment(), nullptr);
}

TEST_F(SessionTest, RecoveringOverUnsavedEditsCanBeUndone) {
    open_scene();
    session().files().save_as(folder);
    session().files().close();
    {
        projects::OpenProject crashed(folder, fake_registry());
        crashed.edit(projects::edits::set_notes(crashed.project(), "crashed"));
        crashed.autosave();
        crashed.wait_for_autosave();
    }
    session().files().open(folder);
    set_notes("edited");
    session().files().take_recovery();
    EXPECT_EQ(session().document().notes, "crashed");
    trigger("undo");
    EXPECT_EQ(session().document().notes, "edited");
}

TEST_F(SessionTest, ViewsAreWrittenWithTheAutosave) {
    open_scene();
    session().files().save_as(folder);
    fs::remove(folder / "session.json");
    QObject::connect(&session().files(), &ProjectFiles::memory_wanted, &window,
                     [&] { session().files().memory()["mark"] = 7; });
    session().files().autosave();
    const auto written = projects::load_session(folder);
    EXPECT_EQ(written.value("mark", 0), 7);
    EXPECT_GT(written.size(), 2u) << "the views and the experiment, too";
    fs::remove(folder / "session.json");
    session().files().autosave();
    EXPECT_FALSE(fs::exists(folder / "session.json")) << "nothing is new";
}

TEST_F(SessionTest, LocatingASceneThatIsGoneDoesNothing) {
    open_scene();
    session().files().add_scene((root / "missing.glb").string());
    ASSERT_TRUE(window.banners().names().contains("scene"));
    std::ofstream(root / "other.glb") << "x";
    when_asked_for_a_file(QString::fromStdString((root / "other.glb").string()),
                          [this] { session().undo(); });
    QPushButton* locate = nullptr;
    for (auto* button : window.banners().findChildren<QPushButton*>())
        if (button->text().startsWith("Locate")) locate = button;
    ASSERT_NE(locate, nullptr);
    locate->click();
    ASSERT_TRUE(QTest::qWaitFor([this] { return steps().can_redo(); }, 60000));
    ASSERT_TRUE(QTest::qWaitFor([] { return !QApplication::activeModalWidget(); }, 60000));
    EXPECT_EQ(session().document().scenes.size(), 1u);
    EXPECT_TRUE(steps().can_redo()) << "nothing was edited";
}

TEST_F(SessionTest, ANewProjectIsSavedUnderItsNameAndItsStepsStay) {
    open_scene();
    set_notes("x");
    QString proposed;
    when_asked_for_a_file(QString::fromStdString(folder.string()), [&proposed] {
        proposed = QApplication::activeModalWidget()->findChild<QLineEdit*>("fileNameEdit")->text();
    });
    window.action("save")->trigger();
    EXPECT_EQ(proposed, "cornell.interreflect");
    EXPECT_EQ(session().open_project().folder(), folder);
    EXPECT_TRUE(steps().can_undo());
}

TEST_F(SessionTest, TheOpenProjectIsNotLostWhereItCannotBeReadAgain) {
    open_scene();
    session().files().save_as(folder);
    std::ofstream(folder / "project.json") << "{ no";
    EXPECT_THROW(session().files().open(folder), Error);
    ASSERT_TRUE(session().has_project());
    EXPECT_FALSE(session().open_project().is_read_only());
    session().files().save(true);
    set_notes("read again");
    session().files().save();
    session().files().open(folder / "project.json");  // by another of its names
    EXPECT_EQ(session().document().notes, "read again");
    EXPECT_FALSE(session().open_project().is_read_only()) << session().open_project().read_only_reason();
}

TEST_F(SessionTest, ARedoneExperimentIsShownAsItWas) {
    open_scene();
    window.views().show_output("depth");
    ASSERT_TRUE(settle());
    const auto first = session().experiment()->id;
    trigger("experiment-add");
    const auto second = session().experiment()->id;
    window.views().show_output("levels", 1);
    ASSERT_TRUE(settle());
    const auto shown = [this] { return window.views().active_state().a; };
    for (int times = 0; times < 2; ++times) {
        trigger("undo");
        EXPECT_EQ(shown(), (widgets::ViewSource{first, "depth"}));
        trigger("redo");
        EXPECT_EQ(shown(), (widgets::ViewSource{second, "levels", 1}));
        EXPECT_EQ(session().experiment()->id, second);
    }
    trigger("undo");
    window.views().show_output("slices");  // somebody looks at something else meanwhile
    trigger("redo");
    EXPECT_EQ(shown(), (widgets::ViewSource{first, "slices"}));
}

TEST_F(SessionTest, TheActiveViewOpensWithTheExperimentItWasLeftWith) {
    open_scene();
    const auto first = session().experiment()->id;
    trigger("experiment-add");
    const auto second = session().experiment()->id;
    session().files().save_as(folder);
    for (const std::string remembered : {"", first.c_str()}) {
        session().files().close();
        auto memory = projects::load_session(folder);
        memory["experiment"] = remembered;
        memory["views"]["active"] = 0;
        memory["views"]["states"][0]["a"]["owner"] = second;
        projects::save_session(folder, memory);
        session().files().open(folder);
        ASSERT_TRUE(settle());
        EXPECT_EQ(window.views().active_state().a.owner, second) << "remembered: " << remembered;
        EXPECT_EQ(session().experiment()->id, second) << "what is worked on is what is shown";
    }
}

TEST_F(SessionTest, AnImageThatIsRefusedIsNotSelected) {
    open_scene();
    session().files().save_as(folder);
    session().files().close();
    const projects::OpenProject other(folder, fake_registry());
    session().files().open(folder);
    ASSERT_TRUE(session().open_project().is_read_only());
    std::ofstream(root / "photo.exr") << "x";
    EXPECT_FALSE(session().files().add_image((root / "photo.exr").string()));
    when_asked_for_a_file(QString::fromStdString((root / "photo.exr").string()), [] {});
    window.document().add_image();
    EXPECT_TRUE(session().document().images.empty());
}

}  // namespace
}  // namespace ir::gui
