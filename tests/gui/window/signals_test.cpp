// What a window that is told to end by a signal leaves behind.
#include <QTemporaryDir>
#include <map>

#include "tests/child_process.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

namespace fs = std::filesystem;

TEST(Leaving, WritesDownWhatIsNotSavedAndGivesTheLockBack) {
    const QTemporaryDir temporary;
    const fs::path folder = fs::path(temporary.path().toStdString()) / "a.interreflect";
    {
        Session session(fake_registry());
        session.files().create_from_scene("builtin:cornell");
        session.files().save_as(folder);
        session.edit(
            [](const projects::Project& project) { return projects::edits::set_notes(project, "late"); });
        session.files().leave();
    }
    EXPECT_TRUE(projects::Lock::is_free(folder));
    EXPECT_FALSE(fs::exists(folder / ".lock"));
    const projects::OpenProject again(folder, fake_registry());
    ASSERT_TRUE(again.recovery().has_value());
    EXPECT_EQ(again.recovery()->project.notes, "late");
}

TEST(Leaving, NothingIsOfferedWhereEverythingWasSaved) {
    const QTemporaryDir temporary;
    const fs::path folder = fs::path(temporary.path().toStdString()) / "a.interreflect";
    {
        Session session(fake_registry());
        session.files().create_from_scene("builtin:cornell");
        session.files().save_as(folder);
        session.files().leave();
    }
    EXPECT_FALSE(fs::exists(folder / ".lock"));
    EXPECT_FALSE(projects::OpenProject(folder, fake_registry()).recovery().has_value());
}

/// The real program, with data folders of its own.
class WindowProgram : public testing::Test {
  protected:
    WindowProgram() {
        for (auto& [variable, before] : homes_) {
            before = qgetenv(variable);
            qputenv(variable, root.c_str());
        }
    }
    ~WindowProgram() override {
        for (const auto& [variable, before] : homes_) qputenv(variable, before);
    }
    /// Those below the data folder.
    std::vector<fs::path> found(const std::string& name) const {
        std::vector<fs::path> paths;
        for (const auto& entry : fs::recursive_directory_iterator(root))
            if (entry.path().filename() == name) paths.push_back(entry.path());
        return paths;
    }
    QTemporaryDir temporary;
    std::string root = temporary.path().toStdString();

  private:
    std::map<const char*, QByteArray> homes_{{"XDG_DATA_HOME", {}}, {"XDG_CONFIG_HOME", {}}};
};

TEST_F(WindowProgram, EndsWithTheStatusOfShellsAndKeepsWhatWasNeverSaved) {
    for (const int signal : {SIGTERM, SIGINT}) {
        SCOPED_TRACE(signal);
        ChildProcess child(WINDOW_PROGRAM, {"builtin:cornell"}, root);
        ASSERT_TRUE(child.reaches([&] { return child.watches(signal); })) << child.err();
        child.send(signal);
        EXPECT_EQ(child.wait(), 128 + signal) << child.err();
        EXPECT_FALSE(child.was_killed());
        const auto kept = found(projects::autosave_file_name);
        ASSERT_EQ(kept.size(), 1u);
        EXPECT_TRUE(found(".lock").empty());
        fs::remove_all(kept.front().parent_path());
    }
}

TEST_F(WindowProgram, GivesTheLockOfASavedProjectBack) {
    const fs::path folder = fs::path(root) / "a.interreflect";
    projects::OpenProject(engine::registry()).save_as(folder);
    ChildProcess child(WINDOW_PROGRAM, {folder.string()}, root);
    ASSERT_TRUE(child.reaches([&] { return fs::exists(folder / ".lock"); })) << child.err();
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM) << child.err();
    EXPECT_FALSE(fs::exists(folder / ".lock"));
    EXPECT_TRUE(found(projects::autosave_file_name).empty());
}

TEST_F(WindowProgram, AScreenshotThatIsInterruptedIsNotThere) {
    const auto file = root + "/window.png";
    ChildProcess child(WINDOW_PROGRAM, {"builtin:cornell", "--screenshot", file}, root);
    ASSERT_TRUE(child.reaches([&] { return child.watches(SIGTERM); })) << child.err();
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 128 + SIGTERM) << child.err();
    EXPECT_FALSE(fs::exists(file));
    EXPECT_TRUE(found(projects::autosave_file_name).empty()) << "nobody changed anything";
}

}  // namespace
}  // namespace ir::gui
