#include <gtest/gtest.h>

#include "projects/check.h"
#include "projects/hash.h"
#include "projects/open_project.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::registry;
using testing::TemporaryFolder;

/// A project all of whose files were moved to another folder.
class Locate : public ::testing::Test {
  protected:
    Locate() {
        testing::write_sample_files(folder);
        save_project(with_missing_hashes(testing::unhashed_sample(), folder), folder, "");
        fs::create_directories(elsewhere);
        for (const char* name : {"scenes", "sky.exr", "photo.exr"})
            fs::rename(folder / name, elsewhere / name);
    }
    int count_missing(const OpenProject& open) {
        int count = 0;
        for (const auto& message : open.messages())
            count += message.text.find("is missing; locate it") != std::string::npos;
        return count;
    }
    TemporaryFolder temporary;
    fs::path folder = temporary.path() / "a.interreflect", elsewhere = temporary.path() / "archive/2026";
    std::map<std::string, std::string> moved{{"scenes/church.glb", "../archive/2026/scenes/church.glb"},
                                             {"scenes/organ.glb", "../archive/2026/scenes/organ.glb"},
                                             {"sky.exr", "../archive/2026/sky.exr"},
                                             {"photo.exr", "../archive/2026/photo.exr"}};
};

TEST_F(Locate, AllFilesInOneUndoStep) {
    OpenProject open(folder, registry());
    EXPECT_EQ(count_missing(open), 4);
    open.edit(edits::relocate(open.project(), moved));
    open.check_again();
    EXPECT_EQ(count_missing(open), 0);
    open.wait_for_files();
    for (const auto& part : open.project().scenes[0].parts)
        EXPECT_EQ(status(part, folder, &open.contents()).state, FileState::ok) << part.source;
    EXPECT_EQ(open.undo_stack().position(), 1u);
    open.undo();
    EXPECT_EQ(open.project(), load_project(folder, registry()).project);
}

TEST_F(Locate, AnotherFileShowsAsChangedUntilItIsAccepted) {
    testing::write_text(elsewhere / "scenes/organ.glb", "a newer organ");
    OpenProject open(folder, registry());
    open.edit(edits::relocate(open.project(), moved));
    open.wait_for_files();
    const auto state = [&] {
        return status(open.project().scenes[0].parts[1], folder, &open.contents()).state;
    };
    EXPECT_EQ(state(), FileState::changed);
    const auto accept = [&] {
        return edits::change(open.project(),
                             with_current_hashes(open.project().scenes[0], folder, &open.contents()));
    };
    EXPECT_TRUE(open.edit(accept()));
    EXPECT_EQ(state(), FileState::ok);
    EXPECT_EQ(open.project().scenes[0].parts[1].content_hash, hash_bytes("a newer organ"));
    EXPECT_FALSE(open.edit(accept())) << "nothing left to accept";
    open.undo();
    EXPECT_EQ(state(), FileState::changed);
    open.save();
    EXPECT_EQ(load_project(folder, registry()).project, open.project());
}

TEST_F(Locate, ExperimentsSurviveAMissingScene) {
    OpenProject open(folder, registry());
    EXPECT_EQ(open.project().experiments, load_project(folder, registry()).project.experiments);
    EXPECT_NE(why_not_runnable(open.project(), open.project().experiments[0], registry(), folder), "");
    open.edit(edits::set_seed(open.project(), "fog-nave", 5));
    open.save();
    EXPECT_EQ(load_project(folder, registry()).project.experiments[0].seed, 5u);
}

}  // namespace
}  // namespace ir::projects
