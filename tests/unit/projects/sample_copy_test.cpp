#include "projects/sample_copy.h"

#include <gtest/gtest.h>

#include <map>

#include "projects/autosave.h"
#include "projects/lock.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::registry;
using testing::TemporaryFolder;

/// An installation with a sample, and the user's data.
class SampleCopies : public ::testing::Test {
  protected:
    void SetUp() override {
        testing::write_text(installation.path() / "scenes/room.gltf", "{}");
        Project project;
        project.name = "A sample";
        Scene scene;
        scene.id = scene.name = "room";
        scene.parts = {{"../scenes/room.gltf", "", {}}, {"builtin:cornell@1", "", {}}};
        project.scenes = {scene};
        ForeignImage image;
        image.id = image.name = "photo";
        image.source = "photo.exr";
        project.images = {image};
        save_project(project, sample, "");
        testing::write_text(sample / "photo.exr", "pixels");
        testing::write_text(sample / "session.json", R"({"views": 4})");
    }
    SampleCopy copy() { return copy_of_sample(sample, data.path() / "samples", registry()); }
    void rename_project(const fs::path& folder, const std::string& name) {
        auto project = load_project(folder, registry()).project;
        project.name = name;
        save_project(project, folder, "");
    }
    std::string name_of(const fs::path& folder) { return load_project(folder, registry()).project.name; }
    std::map<std::string, std::string> all_files() {
        std::map<std::string, std::string> files;
        for (const auto& file : real_file_system().list(installation.path()))
            files[file.string()] = testing::read_text(installation.path() / file);
        return files;
    }

    TemporaryFolder installation, data;
    fs::path sample = installation.path() / "a.interreflect";
};

TEST_F(SampleCopies, MeansTheSameFilesAndLeavesTheSampleAlone) {
    const auto before = all_files();
    const auto made = copy();
    EXPECT_EQ(made.folder, data.path() / "samples/a.interreflect");
    EXPECT_FALSE(made.is_changed);
    EXPECT_FALSE(made.is_outdated);
    EXPECT_EQ(all_files(), before);
    const auto project = load_project(made.folder, registry()).project;
    EXPECT_EQ(resolve(project.scenes[0].parts[0].source, made.folder),
              fs::canonical(installation.path()) / "scenes/room.gltf");
    EXPECT_EQ(project.scenes[0].parts[1].source, "builtin:cornell@1");
    EXPECT_EQ(project.images[0].source, "photo.exr") << "what lies in the project came along";
    EXPECT_EQ(testing::read_text(made.folder / "photo.exr"), "pixels");
    EXPECT_EQ(load_session(made.folder)["views"], 4);
}

TEST_F(SampleCopies, AChangedOneIsTakenAsItWasLeft) {
    rename_project(copy().folder, "Mine");
    const auto again = copy();
    EXPECT_TRUE(again.is_changed);
    EXPECT_FALSE(again.is_outdated);
    EXPECT_EQ(name_of(again.folder), "Mine");
}

TEST_F(SampleCopies, LookingChangesNothing) {
    save_session(copy().folder, {{"views", 1}});
    const auto again = copy();
    EXPECT_FALSE(again.is_changed);
    EXPECT_EQ(load_session(again.folder)["views"], 1);
}

TEST_F(SampleCopies, FollowsANewerSampleUnlessSomebodyChangedIt) {
    copy();
    rename_project(sample, "A newer sample");
    const auto fresh = copy();
    EXPECT_EQ(name_of(fresh.folder), "A newer sample");
    EXPECT_FALSE(fresh.is_outdated);
}

TEST_F(SampleCopies, WorkInOneIsNeverReplaced) {
    for (const char* work : {"project.json.autosave", "results/k/main.exr"}) {
        fs::remove_all(data.path() / "samples");
        rename_project(sample, "A sample");
        testing::write_text(copy().folder / work, "work");
        rename_project(sample, "A newer sample");
        const auto kept = copy();
        EXPECT_EQ(name_of(kept.folder), "A sample") << work;
        EXPECT_TRUE(kept.is_changed && kept.is_outdated) << work;
        EXPECT_EQ(testing::read_text(kept.folder / work), "work");
    }
}

TEST_F(SampleCopies, OneThatIsOpenElsewhereIsLeftAlone) {
    const auto made = copy();
    const auto lock = Lock::acquire(made.folder);
    ASSERT_TRUE(lock.is_held());
    rename_project(sample, "A newer sample");
    const auto again = copy();
    EXPECT_EQ(name_of(again.folder), "A sample");
    EXPECT_TRUE(again.is_outdated);
    EXPECT_THROW(put_aside(again), Error);
}

TEST_F(SampleCopies, PutAsideAFreshOneTakesItsPlace) {
    rename_project(copy().folder, "Mine");
    EXPECT_EQ(put_aside(copy()), data.path() / "samples/a-2.interreflect");
    EXPECT_EQ(name_of(copy().folder), "A sample");
    rename_project(copy().folder, "Mine, too");
    EXPECT_EQ(put_aside(copy()), data.path() / "samples/a-3.interreflect");
    EXPECT_EQ(name_of(data.path() / "samples/a-2.interreflect"), "Mine");
    EXPECT_EQ(name_of(data.path() / "samples/a-3.interreflect"), "Mine, too");
}

TEST_F(SampleCopies, WithoutAPlaceNothingIsLeftBehind) {
    testing::write_text(data.path() / "samples", "a file where the folder should be");
    EXPECT_THROW(copy(), Error);
    EXPECT_EQ(real_file_system().list(data.path()).size(), 1u);
}

}  // namespace
}  // namespace ir::projects
