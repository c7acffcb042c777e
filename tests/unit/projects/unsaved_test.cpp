#include "projects/unsaved.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "projects/open_project.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/numbered.h"
#include "tests/unit/projects/sample.h"

/// Projects that were never saved outlive the process that edits them.
namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::registry;

class Unsaved : public ::testing::Test {
  protected:
    /// A project with a name and a state, autosaved.
    std::unique_ptr<OpenProject> autosaved(int state) {
        auto open = std::make_unique<OpenProject>(registry());
        open->autosave_unsaved_in(place);
        open->edit(edits::set_project_name(open->project(), "Nave, evening"));
        testing::edit_to(*open, state);
        open->autosave();
        open->wait_for_autosave();
        return open;
    }
    /// Runs `work` in a child that is killed when it is done.
    template <class Work>
    void killed_after(Work work) {
        const pid_t child = ::fork();
        if (child == 0) {
            const auto kept = work();
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status));
    }
    fs::path only_home() {
        const auto found = find_unsaved(place, registry());
        EXPECT_EQ(found.size(), 1u);
        return found.empty() ? fs::path() : found.front().folder;
    }
    bool place_is_empty() { return !fs::exists(place) || fs::is_empty(place); }

    testing::TemporaryFolder temporary;
    fs::path place = temporary.path() / "data/unsaved";
};

TEST_F(Unsaved, AKilledProcessLeavesItsProject) {
    killed_after([&] { return autosaved(7); });
    const auto found = find_unsaved(place, registry());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().name, "Nave, evening");
    EXPECT_EQ(found.front().folder.filename().string().rfind("nave-evening-", 0), 0u);

    const auto open = OpenProject::recover_unsaved(found.front().folder, registry());
    EXPECT_EQ(testing::state_of(open->project()), 7);
    EXPECT_TRUE(open->folder().empty());
    EXPECT_TRUE(open->is_dirty());
    EXPECT_FALSE(open->is_read_only());
    EXPECT_TRUE(find_unsaved(place, registry()).empty()) << "offered although somebody has it";
    EXPECT_THROW(OpenProject::recover_unsaved(found.front().folder, registry()), Error);
}

TEST_F(Unsaved, ARecoveredProjectSurvivesTheNextCrashToo) {
    killed_after([&] { return autosaved(1); });
    const auto home = only_home();
    killed_after([&] { return OpenProject::recover_unsaved(home, registry()); });
    EXPECT_EQ(only_home(), home);
    killed_after([&] {
        auto open = OpenProject::recover_unsaved(home, registry());
        testing::edit_to(*open, 2);
        open->autosave();
        open->wait_for_autosave();
        return open;
    });
    EXPECT_EQ(testing::state_of(OpenProject::recover_unsaved(only_home(), registry())->project()), 2);
}

TEST_F(Unsaved, GoesWithTheFirstSaveAndWithAProperClose) {
    auto saved = autosaved(1);
    EXPECT_EQ(std::distance(fs::directory_iterator(place), {}), 1);
    saved->save_as(temporary.path() / "saved");
    EXPECT_TRUE(place_is_empty());
    testing::edit_to(*saved, 2);
    saved->autosave();
    saved->wait_for_autosave();
    EXPECT_TRUE(place_is_empty()) << "a saved project is autosaved in its folder";
    EXPECT_TRUE(fs::exists(temporary.path() / "saved.interreflect" / autosave_file_name));
    saved->close();

    autosaved(1)->close();
    EXPECT_TRUE(place_is_empty());

    killed_after([&] { return autosaved(3); });
    OpenProject::recover_unsaved(only_home(), registry())->save_as(temporary.path() / "recovered");
    EXPECT_TRUE(place_is_empty());
    const auto project = load_project(temporary.path() / "recovered.interreflect", registry()).project;
    EXPECT_EQ(testing::state_of(project), 3);
}

TEST_F(Unsaved, AFailedSaveKeepsIt) {
    auto open = autosaved(1);
    testing::write_text(temporary.path() / "file", "no folder");
    EXPECT_THROW(open->save_as(temporary.path() / "file/inside"), Error);
    testing::edit_to(*open, 2);
    open->autosave();
    open->wait_for_autosave();
    open.reset();  // without close(): as after a crash
    EXPECT_EQ(testing::state_of(OpenProject::recover_unsaved(only_home(), registry())->project()), 2);
}

TEST_F(Unsaved, PathsMeanTheSameFromElsewhere) {
    {
        OpenProject open(registry());
        open.autosave_unsaved_in(place);
        Scene scene{"a", "A", {{"scenes/a.glb", "", {}}}};
        scene.parts.push_back({"builtin:room@1", "", {}});
        open.edit(edits::add(open.project(), scene));
        open.autosave();
        open.wait_for_autosave();
        EXPECT_EQ(open.project().scenes[0].parts[0].source, "scenes/a.glb");
    }
    const auto recovered = OpenProject::recover_unsaved(only_home(), registry());
    const auto& parts = recovered->project().scenes.at(0).parts;
    EXPECT_EQ(parts[0].source, (fs::current_path() / "scenes/a.glb").string());
    EXPECT_EQ(parts[1].source, "builtin:room@1");
}

TEST_F(Unsaved, DamagedOnesAreNotOfferedAndNotRemoved) {
    autosaved(1).reset();
    const auto home = only_home();
    testing::write_text(home / autosave_file_name, "{\"project\": ");
    EXPECT_TRUE(find_unsaved(place, registry()).empty());
    EXPECT_THROW(OpenProject::recover_unsaved(home, registry()), InputError);
    EXPECT_TRUE(fs::exists(home / autosave_file_name));
}

TEST_F(Unsaved, WithoutAPlaceOrChangesNothingIsWritten) {
    OpenProject open(registry());
    open.autosave_unsaved_in(place);
    open.autosave();
    EXPECT_TRUE(place_is_empty());
    open.autosave_unsaved_in({});
    testing::edit_to(open, 1);
    open.autosave();
    EXPECT_TRUE(place_is_empty());
}

TEST_F(Unsaved, APlaceThatCannotBeWrittenIsToldOnce) {
    testing::write_text(temporary.path() / "file", "no folder");
    OpenProject open(registry());
    open.autosave_unsaved_in(temporary.path() / "file/unsaved");
    testing::edit_to(open, 1);
    open.autosave();
    const auto error = open.take_autosave_error();
    EXPECT_NE(error.find("file/unsaved"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
    open.autosave();
    EXPECT_EQ(open.take_autosave_error(), "");
}

}  // namespace
}  // namespace ir::projects
