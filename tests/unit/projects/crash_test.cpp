#include <gtest/gtest.h>

#include <functional>

#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/open_project.h"
#include "projects/results.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/numbered.h"
#include "tests/unit/projects/ordeal_file_system.h"
#include "tests/unit/projects/sample.h"

/// Everything that writes a project, stopped at every single step: by a kill (with torn writes), by a power
/// cut (what was not synced is gone), and by a disk that is full.
namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::edit_to;
using testing::home;
using testing::Killed;
using testing::leave_dead_lock;
using testing::numbered;
using testing::open_again;
using testing::OrdealFileSystem;
using testing::registry;
using testing::saved_hash;
using testing::TemporaryFolder;

KeptResult kept(const std::string& key, const std::string& bytes) {
    KeptResult result;
    result.key = key;
    result.files = {{"main", key + "/main.exr", hash_bytes(bytes)}};
    return result;
}

void add_result(FileSystem& files, const fs::path& folder, const std::string& key, const std::string& bytes) {
    testing::write_text(folder / "results" / key / "main.exr", bytes);
    auto index = ResultIndex::load(folder);
    index.put(kept(key, bytes));
    index.save(folder, files);
}

/// What to prepare in a folder, what to do that will be stopped, and what must be true afterwards.
struct Scenario {
    const char* name;
    std::function<void(const fs::path& root, FileSystem& files)> prepare;
    std::function<void(const fs::path& root, FileSystem& files)> run;
    /// `done`: the run came to its end.
    std::function<void(const fs::path& root, bool done)> check;
};

void PrintTo(const Scenario& scenario, std::ostream* out) {
    *out << scenario.name;
}

fs::path target(const fs::path& root) {
    return root / "b.interreflect";
}

void save_first(const fs::path& root, FileSystem& files) {
    save_project(numbered(1), home(root), "", files);
}

void expect_old_or_new(const fs::path& root, bool done) {
    const auto found = open_again(home(root));
    EXPECT_TRUE(found.saved == 1 || found.saved == 2) << found.saved;
    if (done) {
        EXPECT_EQ(found.saved, 2);
    }
    if (found.saved == 2) {
        EXPECT_EQ(testing::read_text(home(root) / previous_file_name), write_project(numbered(1)));
    }
}

Scenario save_scenario() {
    return {"save", save_first,
            [](const fs::path& root, FileSystem& files) {
                OpenProject open(home(root), registry(), files);
                edit_to(open, 2);
                open.save();
            },
            expect_old_or_new};
}

/// The autosave holds state 2 already, so that nothing may lose it.
Scenario save_after_autosave_scenario() {
    return {"save after autosave", save_first,
            [](const fs::path& root, FileSystem& files) {
                OpenProject open(home(root), registry(), files);
                edit_to(open, 2);
                open.autosave();
                open.wait_for_autosave();
                open.save();
            },
            [](const fs::path& root, bool done) {
                expect_old_or_new(root, done);
                if (done) {
                    EXPECT_TRUE(open_again(home(root)).recoverable.empty());
                }
            }};
}

Scenario autosave_scenario() {
    return {"autosave",
            [](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                write_autosave(numbered(2), home(root), saved_hash(home(root)), files);
            },
            [](const fs::path& root, FileSystem& files) {
                // The same session goes on: its autosave of state 2 is replaced by one of state 3.
                write_autosave(numbered(3), home(root), saved_hash(home(root)), files);
            },
            [](const fs::path& root, bool done) {
                const auto found = open_again(home(root));
                EXPECT_EQ(found.saved, 1);
                EXPECT_TRUE(found.holds(2) || found.holds(3));
                if (done) {
                    EXPECT_TRUE(found.holds(3));
                }
            }};
}

Scenario take_recovery_scenario() {
    return {"take a recovery and save",
            [](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                write_autosave(numbered(2), home(root), saved_hash(home(root)), files);
            },
            [](const fs::path& root, FileSystem& files) {
                OpenProject open(home(root), registry(), files);
                open.take_recovery();
                open.autosave();
                open.wait_for_autosave();
                open.save();
            },
            [](const fs::path& root, bool done) {
                const auto found = open_again(home(root));
                EXPECT_TRUE(found.saved == 1 || found.saved == 2) << found.saved;
                EXPECT_TRUE(found.holds(2));  // it was safe before and is so at any time
                if (done) {
                    EXPECT_EQ(found.saved, 2);
                }
                if (done) {
                    EXPECT_TRUE(found.recoverable.empty());
                }
            }};
}

/// A recovery is on offer and nobody decides; edits go on, are autosaved and saved.
Scenario undecided_recovery_scenario() {
    return {"save beside an undecided recovery",
            [](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                write_autosave(numbered(2), home(root), saved_hash(home(root)), files);
            },
            [](const fs::path& root, FileSystem& files) {
                OpenProject open(home(root), registry(), files);
                edit_to(open, 3);
                open.autosave();
                open.wait_for_autosave();
                open.save();
            },
            [](const fs::path& root, bool done) {
                const auto found = open_again(home(root));
                EXPECT_TRUE(found.saved == 1 || found.saved == 3) << found.saved;
                EXPECT_TRUE(found.holds(2));
                if (done) {
                    EXPECT_EQ(found.saved, 3);
                }
            }};
}

Scenario save_as_scenario() {
    return {"save as",
            [](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                add_result(files, home(root), "k1", "pixels");
                testing::write_text(home(root) / "session.json", "{}");
                write_autosave(numbered(2), home(root), saved_hash(home(root)), files);
            },
            [](const fs::path& root, FileSystem& files) {
                OpenProject open(home(root), registry(), files);
                open.take_recovery();
                open.save_as(target(root));
            },
            [](const fs::path& root, bool done) {
                const auto there = open_again(home(root));
                EXPECT_EQ(there.saved, 1);
                EXPECT_EQ(testing::read_text(home(root) / "results/k1/main.exr"), "pixels");
                if (done) {
                    EXPECT_TRUE(fs::exists(target(root) / project_file_name));
                }
                if (!fs::exists(target(root) / project_file_name)) {
                    EXPECT_TRUE(there.holds(2));
                    return;
                }
                leave_dead_lock(target(root));
                EXPECT_EQ(open_again(target(root)).saved, 2);
                EXPECT_EQ(testing::read_text(target(root) / "results/k1/main.exr"), "pixels");
                const auto index = ResultIndex::load(target(root));
                ASSERT_NE(index.find("k1"), nullptr);
                EXPECT_TRUE(check_results(index, target(root)).empty());
            }};
}

Scenario save_over_scenario() {
    return {"save over another project",
            [](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                add_result(files, home(root), "k1", "pixels");
                save_project(numbered(7), target(root), "", files);
                add_result(files, target(root), "k7", "others");
            },
            [](const fs::path& root, FileSystem& files) {
                OpenProject open(home(root), registry(), files);
                open.save_as(target(root));
            },
            [](const fs::path& root, bool done) {
                EXPECT_EQ(open_again(home(root)).saved, 1);
                leave_dead_lock(target(root));
                const int saved = open_again(target(root)).saved;
                EXPECT_TRUE(saved == 7 || saved == 1) << saved;
                if (done) {
                    EXPECT_EQ(saved, 1);
                }
                if (saved == 1) {
                    EXPECT_EQ(testing::read_text(target(root) / previous_file_name),
                              write_project(numbered(7)));
                }
                // Kept results of either are found, whichever document is there.
                const auto index = ResultIndex::load(target(root));
                EXPECT_NE(index.find("k7"), nullptr);
                EXPECT_TRUE(check_results(index, target(root)).empty());
                if (saved == 1) {
                    EXPECT_NE(index.find("k1"), nullptr);
                }
            }};
}

Scenario upgrade_scenario() {
    static const std::string old = testing::read_text(TEST_DATA "/projects/schema-1.json");
    return {
        "upgrade",
        [](const fs::path& root, FileSystem&) { testing::write_text(home(root) / project_file_name, old); },
        [](const fs::path& root, FileSystem& files) { upgrade_project(home(root), registry(), files); },
        [](const fs::path& root, bool done) {
            const auto loaded = load_project(home(root), registry());
            const bool is_new = loaded.schema_in_file == schema_version;
            if (!is_new) {
                EXPECT_EQ(testing::read_text(home(root) / project_file_name), old);
            }
            if (is_new) {
                EXPECT_EQ(testing::read_text(home(root) / previous_file_name), old);
            }
            if (done) {
                EXPECT_TRUE(is_new);
            }
            OpenProject open(home(root), registry());
            EXPECT_FALSE(open.is_read_only());
        }};
}

Scenario result_index_scenario() {
    return {"keep a result",
            [](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                add_result(files, home(root), "k1", "pixels");
            },
            [](const fs::path& root, FileSystem& files) {
                auto index = ResultIndex::load(home(root), files);
                index.put(kept("k2", "more"));
                index.save(home(root), files);
            },
            [](const fs::path& root, bool done) {
                const auto index = ResultIndex::load(home(root));
                EXPECT_NE(index.find("k1"), nullptr);
                if (done) {
                    EXPECT_NE(index.find("k2"), nullptr);
                }
            }};
}

/// A picture with more samples takes the state of the one before, whose picture the document still names.
Scenario superseded_state_scenario() {
    const auto picture = [](const std::string& key, std::uint64_t samples) {
        KeptResult result = kept(key, key);
        result.state_key = "one picture";
        result.samples = samples;
        result.files.push_back({"state", key + "/state.exr", hash_bytes(key)});
        return result;
    };
    const auto keep_picture = [=](const fs::path& root, FileSystem& files, const std::string& key,
                                  std::uint64_t samples) {
        const ResultsGuard guard(home(root));
        const auto result = picture(key, samples);
        files.create_directories(home(root) / "results" / key);
        for (const auto& file : result.files)
            write_atomically(files, home(root) / "results" / file.path, key);
        keep(home(root), result, {"k1"}, guard, files);
    };
    return {"keep more samples of a picture",
            [=](const fs::path& root, FileSystem& files) {
                save_first(root, files);
                keep_picture(root, files, "k1", 16);
            },
            [=](const fs::path& root, FileSystem& files) { keep_picture(root, files, "k2", 64); },
            [](const fs::path& root, bool done) {
                const auto index = ResultIndex::load(home(root));
                EXPECT_TRUE(check_results(index, home(root)).empty()) << "what is listed is there";
                ASSERT_NE(index.find("k1"), nullptr);
                EXPECT_NE(index.find_state("one picture"), nullptr) << "some state is there at any time";
                if (done) {
                    EXPECT_EQ(index.find_state("one picture")->key, "k2");
                    EXPECT_FALSE(fs::exists(home(root) / "results/k1/state.exr"));
                }
            }};
}

std::vector<Scenario> scenarios() {
    return {save_scenario(),
            save_after_autosave_scenario(),
            autosave_scenario(),
            take_recovery_scenario(),
            undecided_recovery_scenario(),
            save_as_scenario(),
            save_over_scenario(),
            upgrade_scenario(),
            result_index_scenario(),
            superseded_state_scenario()};
}

int steps_of(const Scenario& scenario) {
    TemporaryFolder root(TemporaryFolder::Place::memory);
    OrdealFileSystem files(root.path());
    scenario.prepare(root.path(), files);
    files.settle();
    scenario.run(root.path(), files);
    scenario.check(root.path(), true);
    return files.steps;
}

class Crash : public ::testing::TestWithParam<Scenario> {};

enum class Aftermath { process_killed, power_cut_old_names, power_cut_new_names };

/// Returns whether the step was one that writes bytes.
bool kill_at(const Scenario& scenario, int step, double torn, Aftermath aftermath) {
    TemporaryFolder root(TemporaryFolder::Place::memory);
    OrdealFileSystem files(root.path());
    scenario.prepare(root.path(), files);
    files.settle();
    files.kill_at = step;
    files.torn = torn;
    try {
        scenario.run(root.path(), files);
    } catch (const Killed&) {
    }
    EXPECT_TRUE(files.is_dead());
    if (aftermath != Aftermath::process_killed)
        files.lose_unsynced(aftermath == Aftermath::power_cut_new_names);
    leave_dead_lock(home(root.path()));
    scenario.check(root.path(), false);
    // And the next session can do the same again, over whatever was left behind.
    OrdealFileSystem again(root.path());
    scenario.run(root.path(), again);
    return files.died_writing();
}

TEST_P(Crash, KilledAtEveryStepLeavesTheOldOrTheNewState) {
    const auto& scenario = GetParam();
    const int steps = steps_of(scenario);
    ASSERT_GE(steps, 4);
    int writes = 0;
    for (int step = 0; step < steps; ++step) {
        for (const auto aftermath :
             {Aftermath::process_killed, Aftermath::power_cut_old_names, Aftermath::power_cut_new_names}) {
            for (const double torn : {0.5, 0.0, 1.0}) {
                const bool was_write = kill_at(scenario, step, torn, aftermath);
                if (HasFailure())
                    FAIL() << scenario.name << " killed at step " << step << " of " << steps << ", "
                           << 100 * torn << " % written, aftermath " << static_cast<int>(aftermath);
                writes += was_write;
                if (!was_write) break;
            }
        }
    }
    EXPECT_GT(writes, 0);
    RecordProperty("steps", steps);
}

TEST_P(Crash, AFullDiskAtEveryStepLosesNothing) {
    const auto& scenario = GetParam();
    const int steps = steps_of(scenario);
    int failures = 0;
    for (int step = 0; step < steps; ++step) {
        for (const bool keeps_failing : {false, true}) {
            TemporaryFolder root(TemporaryFolder::Place::memory);
            OrdealFileSystem files(root.path());
            scenario.prepare(root.path(), files);
            files.settle();
            files.fail_at = step;
            files.keeps_failing = keeps_failing;
            try {
                scenario.run(root.path(), files);
            } catch (const Error& error) {
                ++failures;
                const std::string line = error.what();
                EXPECT_EQ(line.find('\n'), std::string::npos) << line;
                EXPECT_EQ(line.rfind(root.path().string(), 0), 0u) << line;  // names the file
            }
            leave_dead_lock(home(root.path()));
            scenario.check(root.path(), false);
            for (const auto& file : real_file_system().list(root.path()))
                EXPECT_TRUE(keeps_failing || file.extension() != ".tmp") << file;
            OrdealFileSystem again(root.path());
            scenario.run(root.path(), again);
            if (HasFailure())
                FAIL() << scenario.name << " failed at step " << step << (keeps_failing ? " and later" : "");
        }
    }
    EXPECT_GT(failures, 2);
}

INSTANTIATE_TEST_SUITE_P(Everything, Crash, ::testing::ValuesIn(scenarios()), [](const auto& info) {
    std::string name = info.param.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

}  // namespace
}  // namespace ir::projects
