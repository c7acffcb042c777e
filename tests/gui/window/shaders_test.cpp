// Errors in shaders: a panel that comes with them and goes when they are mended.
#include <QAbstractButton>
#include <QClipboard>
#include <QDockWidget>
#include <QLineEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>

#include "app/gui/shader_copies.h"
#include "app/gui/status_line.h"
#include "projects/store.h"
#include "renderers/core/line_diff.h"
#include "tests/gui/events.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/finder_dialog.h"

namespace ir::gui {
namespace {

class ShadersWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    void TearDown() override {
        qunsetenv(ShaderDock::editor_variable);
        WindowTest::TearDown();
    }
    ShaderDock& dock() { return *window.findChild<ShaderDock*>(); }
    QDockWidget& frame() { return *window.findChild<QDockWidget*>("shaders"); }
    QString text() { return dock().panel().list().toPlainText(); }
    void tell(const std::vector<ShaderFault>& faults) {
        emit renderer.shader_faults_changed(faults);
        QApplication::processEvents();
    }
    /// The link of the first error, with the keyboard.
    void follow_link() {
        auto& list = dock().panel().list();
        list.setFocus();
        if (!list.textCursor().hasSelection()) QTest::keyClick(&list, Qt::Key_Tab);
        QTest::keyClick(&list, Qt::Key_Return);
    }
    const ShaderFault fault{"lib/light.glsl", 12, "`a' <undeclared>", "float x = a < b;",
                            "/s/lib/light.glsl"};
};

TEST_F(ShadersWindowTest, ThePanelComesWithErrorsAndGoesWithThem) {
    EXPECT_TRUE(frame().isHidden());
    const float before = pixel();
    tell({fault});
    EXPECT_FALSE(frame().isHidden());
    EXPECT_TRUE(dock().panel().title().contains("One error")) << dock().panel().title().toStdString();
    EXPECT_TRUE(text().contains("lib/light.glsl:12 `a' <undeclared>")) << text().toStdString();
    EXPECT_TRUE(text().contains("float x = a < b;")) << text().toStdString();
    EXPECT_EQ(pixel(), before) << "the last good picture stays";
    tell({fault, {"lib/glass.glsl", 0, "odd"}});
    EXPECT_TRUE(dock().panel().title().contains("2 errors"));
    tell({});
    EXPECT_TRUE(frame().isHidden());
    EXPECT_EQ(text(), "");
}

TEST_F(ShadersWindowTest, APanelThatAPersonOpenedStays) {
    trigger("dock-shaders");
    EXPECT_FALSE(frame().isHidden());
    tell({fault});
    tell({});
    EXPECT_FALSE(frame().isHidden());
}

TEST_F(ShadersWindowTest, APanelThatAPersonOpensAgainDuringErrorsStays) {
    tell({fault});
    frame().close();
    trigger("dock-shaders");
    EXPECT_FALSE(frame().isHidden());
    tell({});
    EXPECT_FALSE(frame().isHidden());
}

/// A copy of a shader, edited by a program that adds a line.
class EditedCopyTest : public ShadersWindowTest {
  protected:
    void SetUp() override {
        ShadersWindowTest::SetUp();
        const auto script = folder.filePath("editor");
        std::ofstream(script.toStdString()) << "#!/bin/sh\necho '// mine' >> \"$1\"\necho \"$1\" > '"
                                            << folder.filePath("edited").toStdString() << "'\n";
        QFile::setPermissions(script, QFile::ReadOwner | QFile::ExeOwner);
        qputenv(ShaderDock::editor_variable, ('"' + script + "\" {file}").toUtf8());
    }
    const ShaderChanges& shaders() { return window.session().experiment()->shaders; }
    bool has_change() {
        return QTest::qWaitFor([this] { return shaders().count(file) == 1; });
    }
    /// The copy that the editor was given.
    QString copy() { return read(folder.filePath("edited")).trimmed(); }
    static QString read(const QString& name) {
        QFile file(name);
        return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
    }
    /// As a person does: a key, words, Enter.
    void edit_copy() {
        QTest::keyClick(&window, Qt::Key_E, Qt::ControlModifier | Qt::AltModifier);
        widgets::FinderDialog* dialog = nullptr;
        ASSERT_TRUE(QTest::qWaitFor([&] {
            dialog = window.findChild<widgets::FinderDialog*>();
            return dialog && dialog->isVisible();
        }));
        auto* line = dialog->findChild<QLineEdit*>();
        EXPECT_EQ(line->placeholderText(), "Find a shader file …");
        QTest::keyClicks(line, "random.glsl");
        QTest::keyClick(line, Qt::Key_Return);
    }
    /// The project again, as one that somebody else has made.
    void open_as_of_others() {
        auto project = window.session().document();
        project.shaders_allowed = false;
        const auto place = std::filesystem::path(folder.path().toStdString()) / "a.interreflect";
        projects::save_project(project, place, "");
        window.session().files().close();
        ASSERT_TRUE(window.open_path(QString::fromStdString(place.string())));
    }
    const std::string file = "lib/random.glsl";
    void append(const std::string& words) { std::ofstream(copy().toStdString(), std::ios::app) << words; }
    int errors() { return window.messages().model().count(Severity::error); }
    QTemporaryDir folder;
};

TEST_F(EditedCopyTest, WhatIsSavedIsTheExperimentsAloneAndCanBeUndone) {
    add_second_experiment(0.5);
    edit_copy();
    ASSERT_TRUE(has_change());
    EXPECT_TRUE(window.session().document().experiments[1].shaders.empty());
    ASSERT_TRUE(settle());
    EXPECT_EQ(renderer.requests.back().experiment.shaders, shaders()) << "its picture is asked for again";
    EXPECT_FALSE(frame().isHidden());
    EXPECT_TRUE(text().contains("lib/random.glsl +1 −0")) << text().toStdString();
    EXPECT_TRUE(text().contains("+// mine"));
    EXPECT_TRUE(text().contains("Edit and save " + copy())) << text().toStdString();
    emit dock().panel().path_wanted(QString::fromStdString(file));
    EXPECT_EQ(QApplication::clipboard()->text(), copy());
    EXPECT_TRUE(read(copy()).endsWith("// mine\n"));

    trigger("undo");
    EXPECT_TRUE(shaders().empty());
    EXPECT_FALSE(read(copy()).contains("// mine")) << "editors follow";
    EXPECT_TRUE(text().contains("lib/random.glsl not changed yet")) << text().toStdString();
    trigger("redo");
    EXPECT_TRUE(read(copy()).endsWith("// mine\n"));
    trigger("experiment-duplicate");
    EXPECT_EQ(shaders().size(), 1u) << "a copy of the experiment takes it along";

    auto& list = dock().panel().list();
    list.setFocus();
    QTest::keyClick(&list, Qt::Key_Tab);
    while (list.textCursor().selectedText() != "Remove change") QTest::keyClick(&list, Qt::Key_Tab);
    QTest::keyClick(&list, Qt::Key_Return);
    EXPECT_TRUE(shaders().empty());
    EXPECT_EQ(window.session().document().experiments[0].shaders.size(), 1u);
}

TEST_F(EditedCopyTest, PassesOnTheHostLeadToOpenGL) {
    auto* on_host = window.inspector().explain_panel().findChild<QLabel*>("on-host");
    renderer.has_two_bodies = true;
    window.live().render_again();
    window.inspector().explain({20, 10});
    ASSERT_TRUE(settle());
    EXPECT_TRUE(on_host->isHidden()) << "nothing is changed";
    edit_copy();
    ASSERT_TRUE(has_change());
    ASSERT_TRUE(settle());
    EXPECT_FALSE(on_host->isHidden());
    EXPECT_TRUE(on_host->text().contains("nothing: paint. ")) << on_host->text().toStdString();
    EXPECT_TRUE(text().contains("nothing: paint. Run them on OpenGL")) << text().toStdString();
    const auto before = renderer.machine.processor;
    EXPECT_NE(renderer.machine.chosen_processor(), Processor::gl);
    auto& list = dock().panel().list();
    list.setFocus();
    QTest::keyClick(&list, Qt::Key_Tab);
    QTest::keyClick(&list, Qt::Key_Return);
    EXPECT_EQ(renderer.machine.chosen_processor(), Processor::gl);
    emit renderer.failed(window.session().experiment()->id, "random.glsl:1: odd", false);
    EXPECT_FALSE(text().contains("nothing: paint")) << "no frame has run on the host since";
    EXPECT_TRUE(on_host->isHidden());
    EXPECT_TRUE(window.banners().text("processor").contains("OpenGL"));
    QPushButton* back = nullptr;
    for (auto* button : window.banners().findChildren<QPushButton*>())
        if (button->text() == "Take it back") back = button;
    ASSERT_TRUE(back);
    back->click();
    test::handle_events();
    EXPECT_EQ(renderer.machine.processor, before);
    EXPECT_FALSE(window.banners().names().contains("processor"));
    emit on_host->linkActivated("#use-opengl");
    EXPECT_EQ(renderer.machine.chosen_processor(), Processor::gl);
}

TEST_F(EditedCopyTest, AFileThatAnEditorReplacesIsFollowed) {
    edit_copy();
    ASSERT_TRUE(has_change());
    for (const char* line : {"// second\n", "// third\n"}) {
        const auto aside = copy() + ".new";
        std::ofstream(aside.toStdString()) << read(copy()).toStdString() << line;
        ASSERT_EQ(std::rename(aside.toUtf8(), copy().toUtf8()), 0);
        ASSERT_TRUE(QTest::qWaitFor([&] { return shaders().at(file).find(line) != std::string::npos; }))
            << line;
    }
    EXPECT_EQ(count_lines(shaders().at(file)).added, 3);
}

TEST_F(EditedCopyTest, WhatCanBeNoChangeIsNotLost) {
    edit_copy();
    ASSERT_TRUE(has_change());
    const auto before = shaders();
    const auto errors_before = errors();
    append("// " + std::string(most_hunk_bytes, 'x') + "\n");
    ASSERT_TRUE(QTest::qWaitFor([&] { return errors() > errors_before; })) << "it is too long";
    EXPECT_EQ(shaders(), before);
    window.session().edit([](const projects::Project& project) {
        return projects::edits::set_notes(project, "Something else.");
    });
    EXPECT_TRUE(read(copy()).endsWith("xxx\n")) << "other edits leave it there";
    trigger("undo");
    trigger("undo");
    EXPECT_TRUE(shaders().empty());
    EXPECT_FALSE(read(copy()).contains("// mine"));
    EXPECT_TRUE(read(copy() + ".before").endsWith("xxx\n"));
    append("// " + std::string(most_hunk_bytes, 'y') + "\n");
    trigger("redo");
    EXPECT_TRUE(read(copy() + ".before-2").endsWith("yyy\n"));
    EXPECT_TRUE(read(copy() + ".before").endsWith("xxx\n")) << "the first is still there";
}

/// Lines of a program's shader, some of them replaced.
std::string lines_with(const std::map<int, std::string>& others) {
    std::string all;
    for (int i = 1; i <= 30; ++i)
        all += (others.count(i) ? others.at(i) : "line " + std::to_string(i)) + "\n";
    return all;
}

TEST_F(EditedCopyTest, AnOldCopyTakesBackNothingThatIsNewInTheProgram) {
    const auto program = std::filesystem::path(folder.path().toStdString()) / "shaders";
    std::filesystem::create_directories(program / "lib");
    const auto now_has = [&](const std::string& text) { std::ofstream(program / file) << text; };
    now_has(lines_with({}));
    ShaderCopies copies(window.session(), program);
    const auto path = copies.open(window.session().experiment()->id, file);
    const auto saved = [&](const std::string& text) { std::ofstream(path) << text; };
    now_has(lines_with({{3, "new in the program"}}));
    saved(lines_with({{28, "mine"}}));  // an editor had it open since before
    ASSERT_TRUE(has_change());
    EXPECT_EQ(count_lines(shaders().at(file)).text(), "+1 −1");
    const auto text_now = [&] { return read(QString::fromStdString(path.string())); };
    EXPECT_TRUE(QTest::qWaitFor([&] { return text_now().contains("new in the program"); }));
    EXPECT_TRUE(text_now().contains("mine"));
    const auto before = shaders();
    const auto errors_before = errors();
    now_has(lines_with({{27, "new"}, {28, "in the same"}, {29, "place"}}));
    saved(lines_with({{28, "mine, too"}}));
    ASSERT_TRUE(QTest::qWaitFor([&] { return errors() > errors_before; }));
    EXPECT_EQ(shaders(), before) << "it is refused with a line";
    EXPECT_TRUE(text_now().contains("mine, too")) << "and stays in the file";
}

/// Of what the program has new an editor knows nothing that never had it.
TEST_F(EditedCopyTest, AnOldCopyDoesNotTakeBackALineThatItNeverHad) {
    const auto program = std::filesystem::path(folder.path().toStdString()) / "shaders";
    std::filesystem::create_directories(program / "lib");
    const auto now_has = [&](const std::string& text) { std::ofstream(program / file) << text; };
    now_has(lines_with({}));
    ShaderCopies copies(window.session(), program);
    const auto path = copies.open(window.session().experiment()->id, file);
    const auto errors_before = errors();
    // The program loses lines 10 to 13 and has a new one; somebody removes the same lines, and no other.
    const std::string without = lines_with({{10, "-"}, {11, "-"}, {12, "-"}, {13, "-"}});
    std::string mine = without;
    for (auto at = mine.find("-\n"); at != std::string::npos; at = mine.find("-\n")) mine.erase(at, 2);
    std::string theirs = mine;
    theirs.insert(theirs.find("line 20\n"), "new in the program\n");
    now_has(theirs);
    std::ofstream(path) << mine;
    ASSERT_TRUE(QTest::qWaitFor([&] { return errors() > errors_before || !shaders().empty(); }));
    EXPECT_TRUE(shaders().empty()) << "it would take back the new line: " << shaders().at(file);
}

TEST_F(EditedCopyTest, WhoTakesBackWhatIsNewInTheProgramLosesNothing) {
    const auto program = std::filesystem::path(folder.path().toStdString()) / "shaders";
    std::filesystem::create_directories(program / "lib");
    const auto now_has = [&](const std::string& text) { std::ofstream(program / file) << text; };
    now_has(lines_with({}));
    ShaderCopies copies(window.session(), program);
    const auto path = copies.open(window.session().experiment()->id, file);
    std::filesystem::remove(path.string() + ".before");  // of another test
    now_has(lines_with({{3, "new in the program"}}));
    copies.open(window.session().experiment()->id, file);  // the editor has the new line by now
    const auto text_of = [&](const char* suffix) {
        return read(QString::fromStdString(path.string()) + suffix);
    };
    ASSERT_TRUE(text_of("").contains("new in the program"));
    const auto saved = lines_with({{28, "mine"}});
    std::ofstream(path) << saved;  // and its person has put the old one back
    ASSERT_TRUE(has_change());
    ASSERT_TRUE(QTest::qWaitFor([&] { return text_of("").contains("new in the program"); }))
        << "as if it were an old copy, which nobody can know";
    EXPECT_EQ(text_of(".before").toStdString(), saved) << "but all of it is kept";
}

TEST_F(ShadersWindowTest, AllLinesOfAChangeAreSeen) {
    std::string after = "// first\n";
    for (int i = 0; i < 3000; ++i) after += "// line " + std::to_string(i) + "\n";
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::set_shader(project, project.experiments.front().id, "lib/random.glsl",
                                           line_diff("", after));
    });
    EXPECT_TRUE(text().contains("+// line 2999")) << "what is asked about is shown to its end";
}

TEST_F(EditedCopyTest, AnExperimentThatComesBackIsFollowedAgain) {
    add_second_experiment(0.5);
    const auto id = window.session().experiment()->id;
    edit_copy();
    ASSERT_TRUE(has_change());
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::remove<projects::Experiment>(project, id);
    });
    trigger("undo");
    append("// more\n");
    EXPECT_TRUE(QTest::qWaitFor([&] {
        return window.session().experiment(id)->shaders.at(file).find("// more") != std::string::npos;
    }));
}

TEST_F(EditedCopyTest, CopiesOfWhatWasNeverSavedGoWithIt) {
    edit_copy();
    ASSERT_TRUE(has_change());
    EXPECT_TRUE(QFile::exists(copy()));
    window.session().files().close();
    EXPECT_FALSE(QFile::exists(copy()));
}

TEST_F(EditedCopyTest, ErrorsLeadToTheCopy) {
    edit_copy();
    ASSERT_TRUE(has_change());
    qunsetenv(ShaderDock::editor_variable);
    auto error = fault;
    error.file = file;
    error.path.clear();
    error.is_changed = true;
    tell({error});
    EXPECT_TRUE(text().contains("lib/random.glsl:12 (changed copy)")) << text().toStdString();
    follow_link();
    EXPECT_EQ(QApplication::clipboard()->text(), copy() + ":12");
}

TEST_F(EditedCopyTest, ShadersOfOthersWaitUntilTheyAreAllowed) {
    edit_copy();
    ASSERT_TRUE(has_change());
    open_as_of_others();
    ASSERT_TRUE(settle());
    EXPECT_EQ(state(), LivePictures::State::blocked);
    EXPECT_TRUE(window.banners().text("shaders-of-others").contains("changes shaders"));
    for (auto* button : window.banners().findChildren<QAbstractButton*>())
        if (button->text() == "Show") button->click();
    EXPECT_TRUE(text().contains("+// mine")) << "they are seen before";
    emit dock().panel().edit_wanted(QString::fromStdString(file));
    const auto said = window.findChild<StatusLine*>()->findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(said, [](const auto* each) {
        return each->text().contains("First allow");
    })) << "one's own change is not to wait as theirs";
    for (auto* button : window.banners().findChildren<QAbstractButton*>())
        if (button->text() == "Allow") QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(settle());
    EXPECT_EQ(state(), LivePictures::State::done);
    EXPECT_EQ(window.banners().text("shaders-of-others"), "");
}

TEST_F(EditedCopyTest, OnesOwnChangeInAProjectOfOthersIsOneStep) {
    open_as_of_others();
    qputenv(ShaderDock::editor_variable, "true {file}");  // which saves nothing
    edit_copy();
    EXPECT_FALSE(window.session().open_project().undo_stack().can_undo()) << "nothing has changed yet";
    qputenv(ShaderDock::editor_variable, ('"' + folder.filePath("editor") + "\" {file}").toUtf8());
    edit_copy();
    ASSERT_TRUE(has_change());
    EXPECT_TRUE(window.session().document().shaders_allowed);
    trigger("undo");
    EXPECT_TRUE(shaders().empty());
    EXPECT_FALSE(window.session().document().shaders_allowed);
    EXPECT_FALSE(window.session().open_project().undo_stack().can_undo()) << "it was one step";
}

TEST_F(ShadersWindowTest, ALinkCopiesThePlaceOrOpensTheEditor) {
    tell({fault});
    QApplication::clipboard()->clear();
    follow_link();
    EXPECT_EQ(QApplication::clipboard()->text(), "/s/lib/light.glsl:12");

    const QTemporaryDir folder;
    const auto script = folder.filePath("edit it"), said = folder.filePath("said");
    std::ofstream(script.toStdString()) << "#!/bin/sh\necho \"$1 at $2\" > '" << said.toStdString() << "'\n";
    QFile::setPermissions(script, QFile::ReadOwner | QFile::ExeOwner);
    qputenv(ShaderDock::editor_variable, ('"' + script + "\" {file} {line}").toUtf8());
    follow_link();
    const auto words = [&] {
        QFile file(said);
        return file.open(QIODevice::ReadOnly) ? file.readAll().trimmed() : QByteArray();
    };
    ASSERT_TRUE(QTest::qWaitFor([&] { return !words().isEmpty(); }));
    EXPECT_EQ(words(), "/s/lib/light.glsl at 12");

    qputenv(ShaderDock::editor_variable, "/no/such/editor {file}");
    follow_link();
    EXPECT_TRUE(window.banners().text("shaders").contains("/no/such/editor"));
}

TEST_F(ShadersWindowTest, AMessageOfAShaderLeadsToThePanel) {
    emit window.messages().go_to({Severity::error, "shader", "lib/light.glsl:12: odd", "lib/light.glsl:12"});
    QApplication::processEvents();
    EXPECT_FALSE(frame().isHidden());
}

TEST_F(ShadersWindowTest, WhatShadersPrintStandsInThePanelAndBesideThePixel) {
    renderer.can_print = true;
    window.live().render_again();
    ASSERT_TRUE(settle());
    const auto* printed = window.inspector().explain_panel().findChild<QLabel*>("printed");
    EXPECT_TRUE(printed->isHidden()) << "no pixel is picked";
    const auto said = [&] { return window.workspace().pane(0)->compare().main_view().state().marks.said; };
    EXPECT_EQ(said(), widgets::SaidMark());
    window.inspector().explain({20, 10});
    ASSERT_TRUE(settle());
    EXPECT_FALSE(printed->isHidden());
    EXPECT_TRUE(printed->text().contains("a &lt; b = <b>20</b>")) << printed->text().toStdString();
    EXPECT_TRUE(printed->text().contains("paint.comp:3")) << printed->text().toStdString();
    EXPECT_EQ(said(), (widgets::SaidMark{{20, 10}, "a < b = 20\ndepth = 20"}));
    const auto has_layer = [&] {
        for (const int view : window.workspace().area().open_views())
            for (const auto& layer : window.views().state(view).space.layers)
                if (layer.key == "debug.lines") return true;
        return false;
    };
    EXPECT_TRUE(has_layer()) << "what they draw is a layer";
    window.inspector().explain({4, 2});
    ASSERT_TRUE(settle());
    EXPECT_EQ(said(), (widgets::SaidMark{{4, 2}, "a < b = 4\ndepth = 4"}));
    window.inspector().explain_nothing();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(printed->isHidden());
    EXPECT_EQ(said(), widgets::SaidMark());
}

}  // namespace
}  // namespace ir::gui
