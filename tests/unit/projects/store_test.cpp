#include "projects/store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "projects/autosave.h"
#include "projects/hash.h"
#include "projects/lock.h"
#include "projects/results.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "tests/unit/projects/memory_file_system.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::Killed;
using testing::MemoryFileSystem;
using testing::registry;
using testing::sample_project;
using testing::TemporaryFolder;

const fs::path folder = "p.interreflect";

Project second_version() {
    auto project = sample_project();
    project.name = "Second";
    project.experiments.erase(project.experiments.begin());
    return project;
}

TEST(Store, SavesLoadsAndKeepsThePreviousVersion) {
    TemporaryFolder temporary;
    const auto where = temporary.path() / "a.interreflect";
    const auto hash = save_project(sample_project(), where, "");
    const auto loaded = load_project(where, registry());
    EXPECT_EQ(loaded.project, sample_project());
    EXPECT_EQ(loaded.file_hash, hash);
    EXPECT_EQ(load_project(where / "project.json", registry()).project, sample_project());
    EXPECT_EQ(load_project(fs::path(where.string() + "/"), registry()).project, sample_project());

    const auto next = save_project(second_version(), where, hash);
    EXPECT_EQ(load_project(where, registry()).project, second_version());
    EXPECT_EQ(testing::read_text(where / "project.json.previous"), write_project(sample_project()));
    EXPECT_EQ(save_project(second_version(), where, next), next);  // unchanged: the version before stays
    EXPECT_EQ(testing::read_text(where / "project.json.previous"), write_project(sample_project()));
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(where)) files += entry.exists();
    EXPECT_EQ(files, 2u);
}

TEST(Store, RefusesToOverwriteWhatSomebodyElseWrote) {
    TemporaryFolder temporary;
    const auto hash = save_project(sample_project(), temporary.path(), "");
    testing::write_text(temporary.path() / "project.json", write_project(second_version()) + " ");
    EXPECT_THROW(save_project(sample_project(), temporary.path(), hash), Error);
    EXPECT_EQ(load_project(temporary.path(), registry()).project, second_version());
    save_project(sample_project(), temporary.path(), "");
    EXPECT_EQ(load_project(temporary.path(), registry()).project, sample_project());
}

TEST(Store, NamesWhatIsNoProject) {
    TemporaryFolder temporary;
    EXPECT_THROW(load_project(temporary.path(), registry()), InputError);
    EXPECT_THROW(load_project(temporary.path() / "none", registry()), InputError);
    testing::write_text(temporary.path() / "project.json", "{");
    EXPECT_THROW(load_project(temporary.path(), registry()), InputError);
    testing::write_text(temporary.path() / "project.json.previous", "{}");
    try {
        load_project(temporary.path(), registry());
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("project.json.previous"), std::string::npos);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(testing::read_text(temporary.path() / "project.json"), "{");  // untouched
    EXPECT_EQ(folder_with_suffix("a/b"), "a/b.interreflect");
    EXPECT_EQ(folder_with_suffix("a/b.interreflect/"), "a/b.interreflect");
}

/// A file system on which the first version is saved.
MemoryFileSystem with_first_version() {
    MemoryFileSystem files;
    save_project(sample_project(), folder, "", files);
    files.settle();
    return files;
}

int steps_of_a_save() {
    MemoryFileSystem files = with_first_version();
    save_project(second_version(), folder, "", files);
    return files.steps;
}

TEST(Store, KilledAtAnyStepLeavesTheOldOrTheNewVersion) {
    const int steps = steps_of_a_save();
    ASSERT_GE(steps, 8);
    int old_versions = 0, new_versions = 0;
    for (int kill_at = 0; kill_at < steps; ++kill_at) {
        for (const auto& aftermath : {0, 1, 2}) {
            MemoryFileSystem files = with_first_version();
            files.kill_at = kill_at;
            EXPECT_THROW(save_project(second_version(), folder, "", files), Killed);
            if (aftermath == 0) files.survive();
            if (aftermath > 0) files.lose_unsynced(aftermath == 2);
            const auto project = load_project(folder, registry(), files).project;
            EXPECT_TRUE(project == sample_project() || project == second_version()) << kill_at;
            (project == sample_project() ? old_versions : new_versions)++;
            // And saving works again, over whatever temporary files were left.
            save_project(second_version(), folder, "", files);
            EXPECT_EQ(load_project(folder, registry(), files).project, second_version());
        }
    }
    EXPECT_GT(old_versions, 0);
    EXPECT_GT(new_versions, 0);
}

TEST(Store, WhatIsSavedSurvivesThePowerCut) {
    MemoryFileSystem files = with_first_version();
    save_project(second_version(), folder, "", files);
    files.lose_unsynced(false);
    EXPECT_EQ(load_project(folder, registry(), files).project, second_version());
    EXPECT_EQ(files.read(folder / previous_file_name, 1 << 20), write_project(sample_project()));
}

/// A saver that forgets to sync must fail the same ordeal: the ordeal can tell.
TEST(Store, TheOrdealDetectsAMissingSync) {
    MemoryFileSystem files = with_first_version();
    files.forgets_to_sync = true;
    save_project(second_version(), folder, "", files);
    files.lose_unsynced(true);
    EXPECT_THROW(load_project(folder, registry(), files), InputError);
}

TEST(Store, AFullDiskLosesNothing) {
    const int steps = steps_of_a_save();
    int failures = 0;
    for (int fail_at = -1; fail_at < steps; ++fail_at) {
        MemoryFileSystem files = with_first_version();
        const auto before = files.list();
        files.disk_is_full = fail_at < 0;
        files.fail_at = fail_at;
        try {
            save_project(second_version(), folder, "", files);
        } catch (const Error& error) {
            ++failures;
            EXPECT_NE(std::string(error.what()).find("No space left"), std::string::npos);
            EXPECT_EQ(load_project(folder, registry(), files).project, sample_project());
            for (const auto& name : files.list()) EXPECT_FALSE(name.ends_with(".tmp")) << name;
        }
        files.disk_is_full = false;
        files.fail_at = -1;
        save_project(second_version(), folder, "", files);
        EXPECT_EQ(load_project(folder, registry(), files).project, second_version());
    }
    EXPECT_GE(failures, 2);
}

TEST(Store, AReallyFullDiskLosesNothing) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
    EXPECT_THROW(
        {
            try {
                write_file("/dev/full", "x");
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find("free some space"), std::string::npos);
                throw;
            }
        },
        Error);
}

TEST(Store, UpgradeRewritesTheOldSchema) {
    TemporaryFolder temporary;
    const auto old = testing::read_text(TEST_DATA "/projects/schema-1.json");
    testing::write_text(temporary.path() / "project.json", old);
    const auto changes = upgrade_project(temporary.path(), registry());
    EXPECT_GE(changes.size(), 3u);  // schema, the newer parameter, the method's version
    const auto loaded = load_project(temporary.path(), registry());
    EXPECT_EQ(loaded.schema_in_file, schema_version);
    EXPECT_TRUE(loaded.messages.empty());
    EXPECT_EQ(loaded.project.experiments[0].method_version, 3);
    EXPECT_EQ(loaded.project.experiments[1].method, "teleport");
    EXPECT_EQ(testing::read_text(temporary.path() / "project.json.previous"), old);
    EXPECT_FALSE(fs::exists(temporary.path() / ".lock"));

    const auto lock = Lock::acquire(temporary.path());
    EXPECT_THROW(upgrade_project(temporary.path(), registry()), Error);
}

TEST(Session, IsFreeJsonAndNeverAnError) {
    TemporaryFolder temporary;
    EXPECT_EQ(load_session(temporary.path()), Json::object());
    const Json session = {{"layout", "compare"}, {"zoom", 2.5}, {"pins", {{1, 2}}}};
    save_session(temporary.path(), session);
    EXPECT_EQ(load_session(temporary.path()), session);
    testing::write_text(temporary.path() / "session.json", "damaged");
    EXPECT_EQ(load_session(temporary.path()), Json::object());
}

TEST(Autosave, IsOfferedWhenNewerAndDifferent) {
    MemoryFileSystem files = with_first_version();
    const auto hash = hash_bytes(write_project(sample_project()));
    EXPECT_FALSE(find_recovery(folder, registry(), files));
    write_autosave(sample_project(), folder, hash, files);
    EXPECT_FALSE(find_recovery(folder, registry(), files));  // nothing would be gained
    write_autosave(second_version(), folder, hash, files);
    const auto recovery = find_recovery(folder, registry(), files);
    ASSERT_TRUE(recovery);
    EXPECT_EQ(recovery->project, second_version());

    auto third = second_version();
    third.notes = "saved later";
    save_project(third, folder, "", files);
    EXPECT_FALSE(find_recovery(folder, registry(), files));  // older than the saved project
    remove_autosave(folder, files);
    EXPECT_FALSE(files.exists(folder / autosave_file_name));
}

TEST(Autosave, KilledOrDamagedIsNoRecoveryAndNoError) {
    for (int kill_at = 0; kill_at < 4; ++kill_at) {
        MemoryFileSystem files = with_first_version();
        files.kill_at = kill_at;
        EXPECT_THROW(
            write_autosave(second_version(), folder, hash_bytes(write_project(sample_project())), files),
            Killed);
        files.lose_unsynced(kill_at % 2 == 0);
        const auto recovery = find_recovery(folder, registry(), files);
        EXPECT_TRUE(!recovery || recovery->project == second_version());
        EXPECT_EQ(load_project(folder, registry(), files).project, sample_project());
    }
    MemoryFileSystem files = with_first_version();
    for (const char* damaged : {"", "{", "[]", R"({"base_hash": 3})", R"({"project": {"schema": 99}})"}) {
        write_atomically(files, folder / autosave_file_name, damaged);
        EXPECT_FALSE(find_recovery(folder, registry(), files)) << damaged;
    }
}

TEST(Autosave, ThreadWritesTheNewestRequest) {
    TemporaryFolder temporary;
    AutosaveThread thread;
    auto project = sample_project();
    for (int i = 0; i < 50; ++i) {
        project.notes = std::to_string(i);
        thread.request(project, temporary.path(), "");
    }
    thread.flush();
    EXPECT_EQ(find_recovery(temporary.path(), registry())->project.notes, "49");
    thread.request(project, temporary.path(), "");
    thread.discard(temporary.path());
    thread.flush();
    EXPECT_FALSE(fs::exists(temporary.path() / autosave_file_name));
    thread.request(project, temporary.path() / "gone", "");
    thread.flush();
    EXPECT_NE(thread.take_error(), "");
    EXPECT_EQ(thread.take_error(), "");
}

/// In a folder of somebody else: who opened one would wait for ever.
TEST(Store, PipesAreNotWaitedFor) {
    TemporaryFolder temporary;
    const auto where = temporary.path() / "a.interreflect";
    save_project(sample_project(), where, "");
    fs::create_directories(where / "results");
    for (const char* name : {".lock", "session.json", autosave_file_name, "results/index.json"})
        ASSERT_EQ(::mkfifo((where / name).c_str(), 0600), 0) << name;
    EXPECT_EQ(load_project(where, registry()).project, sample_project());
    EXPECT_EQ(load_session(where), Json::object());
    EXPECT_FALSE(find_recovery(where, registry()).has_value());
    EXPECT_FALSE(Lock::is_free(where));
    EXPECT_FALSE(Lock::acquire(where).is_held());
    EXPECT_THROW(ResultIndex::load(where), InputError);
    fs::remove(where / "project.json");
    ASSERT_EQ(::mkfifo((where / "project.json").c_str(), 0600), 0);
    EXPECT_THROW(load_project(where, registry()), InputError);
}

}  // namespace
}  // namespace ir::projects
