#include <gtest/gtest.h>

#include "projects/hash.h"
#include "projects/open_project.h"
#include "projects/scene_files.h"
#include "tests/unit/projects/sample.h"

/// Files that were added without a look at their content: saving records it once it is known.
namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::registry;

class RecordedHashes : public ::testing::Test {
  protected:
    RecordedHashes() {
        save_project({}, folder, "");
        testing::write_text(folder / "a.glb", "first content");
    }
    static void add_scene(OpenProject& open, const std::string& id) {
        open.edit(edits::add(open.project(), Scene{id, id, {{"a.glb", "", {}}}}));
    }
    std::string saved_hash() {
        return load_project(folder, registry()).project.scenes.at(0).parts[0].content_hash;
    }
    testing::TemporaryFolder temporary;
    fs::path folder = temporary.path() / "p.interreflect";
};

TEST_F(RecordedHashes, AFileThatChangesAfterTheSaveIsReported) {
    const auto hash = hash_file(folder / "a.glb");
    {
        OpenProject open(folder, registry());
        add_scene(open, "a");
        open.wait_for_files();
        const auto steps = open.undo_stack().position();
        open.save();
        EXPECT_FALSE(open.is_dirty());
        EXPECT_EQ(open.undo_stack().position(), steps);
        EXPECT_EQ(open.project().scenes[0].parts[0].content_hash, hash);
        open.close();
    }
    EXPECT_EQ(saved_hash(), hash);
    testing::write_text(folder / "a.glb", "another, longer content");
    OpenProject again(folder, registry());
    again.wait_for_files();
    EXPECT_EQ(status(again.project().scenes[0].parts[0], folder, &again.contents()).state,
              FileState::changed);
}

TEST_F(RecordedHashes, WhatIsNotKnownYetIsRecordedByALaterSave) {
    OpenProject open(folder, registry());
    add_scene(open, "a");
    open.save();  // what the hashing thread found was not taken over yet
    EXPECT_EQ(saved_hash(), "");
    open.wait_for_files();
    EXPECT_FALSE(open.is_dirty());
    open.save();
    EXPECT_EQ(saved_hash(), hash_file(folder / "a.glb"));
}

TEST_F(RecordedHashes, OutliveUndoAndRedo) {
    const auto hash = hash_file(folder / "a.glb");
    OpenProject open(folder, registry());
    add_scene(open, "a");
    open.wait_for_files();
    open.save();
    open.undo();
    open.redo();
    EXPECT_FALSE(open.is_dirty());
    testing::write_text(folder / "a.glb", "another, longer content");
    open.look_at_files();
    open.wait_for_files();
    open.save();
    EXPECT_EQ(saved_hash(), hash) << "the change was never accepted";
    // Who names the file again means it as it is.
    open.edit(edits::remove<Scene>(open.project(), "a"));
    add_scene(open, "b");
    open.save();
    EXPECT_EQ(saved_hash(), hash_file(folder / "a.glb"));
}

TEST_F(RecordedHashes, OfAProjectThatIsSavedForTheFirstTime) {
    OpenProject open(registry());
    open.edit(edits::add(open.project(), Scene{"a", "A", {{(folder / "a.glb").string(), "", {}}}}));
    open.wait_for_files();
    open.save_as(temporary.path() / "q");
    const auto project = load_project(temporary.path() / "q.interreflect", registry()).project;
    EXPECT_EQ(project.scenes[0].parts[0].content_hash, hash_file(folder / "a.glb"));
    EXPECT_EQ(project.scenes[0].parts[0].source, "../p.interreflect/a.glb");
}

}  // namespace
}  // namespace ir::projects
