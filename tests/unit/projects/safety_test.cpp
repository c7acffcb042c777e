#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "projects/autosave.h"
#include "projects/hash.h"
#include "projects/results.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/numbered.h"
#include "tests/unit/projects/ordeal_file_system.h"
#include "tests/unit/projects/sample.h"
#include "tests/unit/scarce_disk.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::edit_to;
using testing::numbered;
using testing::open_again;
using testing::OrdealFileSystem;
using testing::registry;
using testing::saved_hash;
using testing::state_of;
using testing::TemporaryFolder;

/// A saved project in state 1.
class Safety : public ::testing::Test {
  protected:
    Safety() { save_project(numbered(1), folder, ""); }
    /// A session that ended without saying so, with unsaved changes.
    void crash_in_state(int state, bool takes_recovery = false) {
        OpenProject open(folder, registry());
        if (takes_recovery) open.take_recovery();
        edit_to(open, state);
        open.autosave();
        open.wait_for_autosave();
    }
    TemporaryFolder temporary{TemporaryFolder::Place::memory};
    fs::path folder = temporary.path() / "a.interreflect";
};

TEST_F(Safety, AFailedSaveKeepsTheDocumentAndCanBeRepeated) {
    for (int step = 0; step < 8; ++step) {
        TemporaryFolder other(TemporaryFolder::Place::memory);
        save_project(numbered(1), other.path(), "");
        OrdealFileSystem files(other.path());
        OpenProject open(other.path(), registry(), files);
        edit_to(open, 2);
        files.settle();
        files.fail_at = step;
        EXPECT_THROW(open.save(), Error) << step;
        EXPECT_EQ(state_of(open.project()), 2);
        EXPECT_TRUE(open.is_dirty());
        EXPECT_TRUE(open.undo_stack().can_undo());
        open.save();
        EXPECT_FALSE(open.is_dirty());
        EXPECT_EQ(state_of(load_project(other.path(), registry()).project), 2);
        EXPECT_EQ(testing::read_text(other.path() / previous_file_name), write_project(numbered(1)));
    }
}

TEST_F(Safety, AFailedSaveAsLeavesNothingBehind) {
    OrdealFileSystem files(temporary.path());
    OpenProject open(folder, registry(), files);
    edit_to(open, 2);
    const auto target = temporary.path() / "b.interreflect";
    for (const int step : {0, 1, 2, 3}) {
        files.settle();
        files.fail_at = step;
        EXPECT_THROW(open.save_as(target), Error);
        EXPECT_EQ(open.folder(), folder);
        EXPECT_FALSE(fs::exists(target)) << step;
    }
    files.fail_at = -1;
    open.save();  // here, as if nothing had been tried
    EXPECT_EQ(state_of(load_project(folder, registry()).project), 2);
}

TEST_F(Safety, AnAutosaveThatFailedIsTriedAgainAndReportedOnce) {
    OrdealFileSystem files(folder);
    OpenProject open(folder, registry(), files);
    edit_to(open, 2);
    files.settle();
    files.fail_at = 0;
    files.keeps_failing = true;
    open.autosave();
    open.wait_for_autosave();
    const auto error = open.take_autosave_error();
    EXPECT_NE(error.find(autosave_file_name), std::string::npos);
    EXPECT_EQ(error.find('\n'), std::string::npos);
    open.autosave();
    open.wait_for_autosave();
    EXPECT_EQ(open.take_autosave_error(), "") << "the same failure twice";
    files.fail_at = -1;
    open.autosave();  // nothing was edited meanwhile
    open.wait_for_autosave();
    EXPECT_EQ(open.take_autosave_error(), "");
    EXPECT_EQ(find_recovery(folder, registry())->project.notes, "state 2");
}

TEST_F(Safety, AutosavesStopWhenSomebodyElseTookTheLock) {
    OpenProject open(folder, registry());
    edit_to(open, 2);
    testing::leave_foreign_lock(folder);
    testing::write_text(folder / autosave_file_name, "of the other");
    open.autosave();
    open.wait_for_autosave();
    EXPECT_EQ(testing::read_text(folder / autosave_file_name), "of the other");
    EXPECT_NE(open.take_autosave_error().find("somebody else took the lock"), std::string::npos);
    open.autosave();
    EXPECT_EQ(open.take_autosave_error(), "");
    EXPECT_THROW(open.save(), Error);
    open.save_as(temporary.path() / "b");
    EXPECT_EQ(open.take_autosave_error(), "");
    open.close();
    EXPECT_EQ(testing::read_text(folder / autosave_file_name), "of the other");
    EXPECT_EQ(open_again(temporary.path() / "b.interreflect").saved, 2);
}

TEST_F(Safety, ClosingLeavesTheAutosaveOfANewHolderAlone) {
    OpenProject open(folder, registry());
    edit_to(open, 2);
    open.autosave();
    open.wait_for_autosave();
    testing::leave_foreign_lock(folder);
    open.close();
    EXPECT_TRUE(fs::exists(folder / autosave_file_name));
}

TEST_F(Safety, ALockThatWasCleanedAwayIsTakenAgain) {
    OpenProject open(folder, registry());
    edit_to(open, 2);
    fs::remove(folder / ".lock");
    open.save();
    EXPECT_TRUE(fs::exists(folder / ".lock"));
    OpenProject second(folder, registry());
    EXPECT_TRUE(second.is_read_only());

    // But what another process saved in between is not overwritten.
    fs::remove(folder / ".lock");
    save_project(numbered(9), folder, "");
    edit_to(open, 3);
    EXPECT_THROW(open.save(), Error);
    EXPECT_EQ(state_of(load_project(folder, registry()).project), 9);
}

TEST_F(Safety, ARecoveryStaysUntilSomebodyDecides) {
    crash_in_state(2);
    {
        // As `reference` does it: a session that never looks at recoveries.
        OpenProject open(folder, registry());
        open.edit(edits::set_seed(open.project(), "fog-nave", 99));
        open.save();
        open.close();
    }
    {
        OpenProject open(folder, registry());
        ASSERT_TRUE(open.recovery());
        EXPECT_EQ(state_of(open.recovery()->project), 2);
        open.discard_recovery();
        EXPECT_FALSE(open.recovery());
        open.close();
    }
    EXPECT_TRUE(open_again(folder).recoverable.empty());
}

TEST_F(Safety, ClocksThatAreWrongLoseNoUnsavedChanges) {
    crash_in_state(2);
    const auto now = fs::file_time_type::clock::now();
    const auto years = std::chrono::hours(24 * 365 * 20);
    for (const bool is_changed_by_others : {false, true}) {
        if (is_changed_by_others) testing::write_text(folder / project_file_name, write_project(numbered(5)));
        for (const auto saved : {now - years, now + years})
            for (const auto autosaved : {now - years, now + years}) {
                fs::last_write_time(folder / project_file_name, saved);
                fs::last_write_time(folder / autosave_file_name, autosaved);
                const auto recovery = find_recovery(folder, registry());
                ASSERT_TRUE(recovery) << is_changed_by_others;
                EXPECT_EQ(state_of(recovery->project), 2);
            }
    }
}

TEST_F(Safety, SeveralCrashesInARowAreAllOffered) {
    crash_in_state(2);
    crash_in_state(3);  // nobody decided about 2, edits went on from 1
    OpenProject open(folder, registry());
    ASSERT_TRUE(open.recovery());
    EXPECT_EQ(state_of(open.recovery()->project), 3);  // the newest first
    open.discard_recovery();
    ASSERT_TRUE(open.recovery());
    EXPECT_EQ(state_of(open.recovery()->project), 2);
    open.take_recovery();
    EXPECT_EQ(state_of(open.project()), 2);
    EXPECT_TRUE(open.is_dirty());
    open.save();
    open.close();
    const auto found = open_again(folder);
    EXPECT_EQ(found.saved, 2);
    EXPECT_TRUE(found.recoverable.empty());
}

TEST_F(Safety, ARecoveryThatWasTakenOverIsReplacedByItsSuccessor) {
    crash_in_state(2);
    crash_in_state(3, true);  // took 2 over, went on to 3
    EXPECT_EQ(open_again(folder).recoverable, std::set<int>{3});
}

TEST_F(Safety, TakingARecoveryCanBeUndoneBackToUnsavedEdits) {
    crash_in_state(2);
    {
        OpenProject open(folder, registry());
        edit_to(open, 3);
        open.take_recovery();
        EXPECT_EQ(state_of(open.project()), 2);
        open.set_last_kept({{"fog-nave", "key"}});
        open.undo();
        EXPECT_EQ(state_of(open.project()), 3);
        EXPECT_EQ(find_item(open.project().experiments, "fog-nave")->last_kept_key, "key");
        open.redo();
        EXPECT_EQ(state_of(open.project()), 2);
        open.undo();
        open.undo();
        EXPECT_EQ(state_of(open.project()), 1);
        EXPECT_FALSE(open.undo_stack().can_undo());
        open.redo();
        open.save();
        open.close();
    }
    const auto found = open_again(folder);
    EXPECT_EQ(found.saved, 3);
    EXPECT_EQ(found.recoverable, std::set<int>{2}) << "undone, it is as if nobody had decided";
}

TEST_F(Safety, TwoRecoveriesTakenInTurnAreBothSafeUntilSaved) {
    crash_in_state(2);
    crash_in_state(3);
    {
        OpenProject open(folder, registry());
        open.take_recovery();
        open.take_recovery();
        open.autosave();
        open.wait_for_autosave();
    }
    EXPECT_EQ(open_again(folder).recoverable, (std::set<int>{2, 3}));
}

TEST_F(Safety, AnUndoneRecoveryIsNotReplacedByTheNextAutosave) {
    crash_in_state(2);
    {
        OpenProject open(folder, registry());
        edit_to(open, 3);
        open.take_recovery();
        open.undo();
        open.autosave();
        open.wait_for_autosave();
    }
    EXPECT_EQ(open_again(folder).recoverable, (std::set<int>{2, 3}));
}

TEST_F(Safety, ARecoveryEqualToWhatIsSavedGoes) {
    crash_in_state(2);
    {
        OpenProject open(folder, registry());
        edit_to(open, 2);
        open.save();
    }
    OpenProject open(folder, registry());
    EXPECT_FALSE(open.recovery());
    for (const auto& entry : fs::directory_iterator(folder))
        EXPECT_EQ(entry.path().string().find("recovery"), std::string::npos) << entry.path();
}

TEST_F(Safety, DiscardingChangesAtTheEndDiscardsTheirRecovery) {
    crash_in_state(2);
    {
        OpenProject open(folder, registry());
        open.take_recovery();
        open.close();  // the user chose not to save
    }
    EXPECT_TRUE(open_again(folder).recoverable.empty());
}

TEST_F(Safety, SaveAsKeepsTheResultsOfBothProjects) {
    const auto target = temporary.path() / "b.interreflect";
    save_project(numbered(7), target, "");
    for (const auto& [where, key] : {std::pair{folder, "k1"}, std::pair{target, "k7"}}) {
        testing::write_text(where / "results" / key / "main.exr", key);
        ResultIndex index;
        KeptResult result;
        result.key = key;
        result.files = {{"main", std::string(key) + "/main.exr", hash_bytes(key)}};
        index.put(result);
        index.save(where);
    }
    OpenProject open(folder, registry());
    open.save_as(target);
    const auto index = ResultIndex::load(target);
    EXPECT_EQ(index.entries().size(), 2u);
    EXPECT_TRUE(check_results(index, target).empty());

    // A damaged index of the other project is no reason to overwrite it; one of our own comes along.
    testing::write_text(folder / "results/index.json", "damaged");
    OpenProject again(folder, registry());
    EXPECT_THROW(
        {
            testing::write_text(target / "results/index.json", "damaged");
            open.close();
            again.save_as(target);
        },
        InputError);
    again.save_as(temporary.path() / "c");
    EXPECT_EQ(testing::read_text(temporary.path() / "c.interreflect/results/index.json"), "damaged");
}

/// Saves a project that has outgrown its place: refused with one line that names the file, nothing lost, and
/// saved as soon as there is room.
std::string outgrow(const fs::path& folder, const std::function<void()>& make_room) {
    OpenProject open(folder, registry());
    if (open.is_read_only()) return "read-only: " + open.read_only_reason();
    open.edit(edits::set_notes(open.project(), std::string(400'000, 'x') + " 2"));
    open.autosave();
    open.wait_for_autosave();
    if (open.take_autosave_error().find(autosave_file_name) == std::string::npos) return "no autosave error";
    std::string line = "saved";
    try {
        open.save();
    } catch (const Error& error) {
        line = error.what();
    }
    if (line.rfind(folder.string(), 0) != 0 || line.find('\n') != std::string::npos) return line;
    if (line.find("free some space") == std::string::npos) return line;
    if (!open.is_dirty()) return "clean after a failed save";
    if (state_of(load_project(folder, registry()).project) != 1) return "the saved version is lost";
    make_room();
    open.autosave();
    open.wait_for_autosave();
    if (!fs::exists(folder / autosave_file_name)) return "no autosave although there is room";
    open.save();
    return state_of(load_project(folder, registry()).project) == 2 ? "ok" : "not saved";
}

TEST_F(Safety, ALimitOnTheSizeOfFilesLosesNothing) {
    const auto answer = in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        rlimit limit{};
        ::getrlimit(RLIMIT_FSIZE, &limit);
        limit.rlim_cur = 100'000;
        ::setrlimit(RLIMIT_FSIZE, &limit);
        return outgrow(folder, [&] {
            limit.rlim_cur = limit.rlim_max;
            ::setrlimit(RLIMIT_FSIZE, &limit);
        });
    });
    EXPECT_EQ(answer, "ok");
}

TEST_F(Safety, AFullDiskLosesNothing) {
    const auto disk = temporary.path() / "disk";
    fs::create_directories(disk);
    const auto answer = in_child([&]() -> std::string {
        if (!mount_private("tmpfs", disk, 0, "size=256k")) return "not allowed";
        save_project(numbered(1), disk / "a.interreflect", "");
        return outgrow(disk / "a.interreflect",
                       [&] { ::mount("tmpfs", disk.c_str(), "tmpfs", MS_REMOUNT, "size=16m"); });
    });
    if (answer == "not allowed")
        GTEST_SKIP() << "needs the right to mount; its twin limits the size of files";
    EXPECT_EQ(answer, "ok");
}

/// What a folder that cannot be written must allow.
std::string use_read_only(const fs::path& folder, const fs::path& elsewhere) {
    OpenProject open(folder, registry());
    if (!open.is_read_only()) return "writable";
    const auto reason = open.read_only_reason();
    if (reason.find("read-only") == std::string::npos || reason.find(folder.string()) == std::string::npos ||
        reason.find('\n') != std::string::npos)
        return "reason: " + reason;
    if (state_of(open.project()) != 1) return "another state";
    open.autosave();
    open.wait_for_autosave();
    try {
        edit_to(open, 2);
        return "edited";
    } catch (const UsageError& error) {
        if (error.what() != reason) return error.what();
    }
    open.break_lock();  // nobody holds it: that cannot help
    if (!open.is_read_only()) return "writable by force";
    open.save_as(elsewhere);
    edit_to(open, 2);
    open.save();
    return state_of(load_project(elsewhere, registry()).project) == 2 ? "ok" : "not saved elsewhere";
}

TEST_F(Safety, AFolderWithoutRightsOpensReadOnly) {
    const auto elsewhere = temporary.path() / "elsewhere";
    fs::create_directories(elsewhere);
    fs::permissions(temporary.path(), fs::perms::all);
    fs::permissions(elsewhere, fs::perms::all);
    fs::permissions(folder, fs::perms(0555));
    const auto answer = in_child([&]() -> std::string {
        // The rights of root would hide what is tested.
        if (::geteuid() == 0 && ::seteuid(65534) != 0) return "cannot become nobody";
        return use_read_only(folder, elsewhere / "b.interreflect");
    });
    fs::permissions(folder, fs::perms::owner_all);
    EXPECT_EQ(answer, "ok");
}

TEST_F(Safety, AReadOnlyMediumOpensReadOnly) {
    const auto medium = temporary.path() / "medium";
    fs::create_directories(medium);
    const auto answer = in_child([&]() -> std::string {
        if (!mount_private("tmpfs", medium, 0, "size=1m")) return "not allowed";
        save_project(numbered(1), medium / "a.interreflect", "");
        if (::mount("tmpfs", medium.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "size=1m") != 0)
            return "no remount";
        return use_read_only(medium / "a.interreflect", temporary.path() / "b.interreflect");
    });
    if (answer == "not allowed") GTEST_SKIP() << "needs the right to mount; its twin takes the rights away";
    EXPECT_EQ(answer, "ok");
}

TEST_F(Safety, AnotherHostsLockOpensReadOnlyUntilItIsBroken) {
    testing::leave_foreign_lock(folder);
    write_autosave(numbered(2), folder, saved_hash(folder));
    OpenProject open(folder, registry());
    EXPECT_TRUE(open.is_read_only());
    EXPECT_NE(open.read_only_reason().find("on host elsewhere"), std::string::npos);
    EXPECT_FALSE(open.recovery());  // it is the other's present autosave
    EXPECT_TRUE(fs::exists(folder / autosave_file_name));
    EXPECT_THROW(open.save(), UsageError);
    open.break_lock();
    EXPECT_FALSE(open.is_read_only());
    EXPECT_TRUE(open.recovery());
    edit_to(open, 3);
    open.save();
    EXPECT_EQ(state_of(load_project(folder, registry()).project), 3);
}

TEST_F(Safety, ADamagedProjectNamesWhatElseThereIs) {
    write_autosave(numbered(2), folder, saved_hash(folder));
    save_project(numbered(3), folder, "");
    testing::write_text(folder / project_file_name, "{");
    try {
        OpenProject open(folder, registry());
        FAIL();
    } catch (const InputError& error) {
        const std::string line = error.what();
        EXPECT_EQ(line.rfind((folder / project_file_name).string(), 0), 0u) << line;
        EXPECT_NE(line.find(previous_file_name), std::string::npos) << line;
        EXPECT_NE(line.find(autosave_file_name), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
    EXPECT_EQ(testing::read_text(folder / project_file_name), "{");
    EXPECT_FALSE(fs::exists(folder / ".lock"));
}

}  // namespace
}  // namespace ir::projects
