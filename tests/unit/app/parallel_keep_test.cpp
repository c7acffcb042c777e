// Several processes of the real program keep results in one project at the same time, with and without a
// window that has it open and unsaved.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/engine/execution.h"
#include "projects/open_project.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class ParallelKeeping : public testing::Test {
  protected:
    ParallelKeeping() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = own_folder("parallel-" + std::string(test->name()));
        fs::remove_all(root_);
        project = root_ / "p.interreflect";
        fs::create_directories(project);
    }
    ~ParallelKeeping() override { fs::remove_all(root_); }

    static std::string id(int number) { return "e" + std::to_string(number); }
    /// Experiments that differ by their seeds alone.
    void make(int experiments, const std::string& method) const {
        Json json{{"schema", projects::schema_version},
                  {"name", "Parallel"},
                  {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
                  {"experiments", Json::array()}};
        for (int i = 0; i < experiments; ++i)
            json["experiments"].push_back(
                {{"id", id(i)}, {"scene", "box"}, {"method", method}, {"size", {16, 16}}, {"seed", i}});
        std::ofstream(project / "project.json") << json.dump(1);
    }
    /// Runs the command line of each at the same time. All must end well.
    void run(const std::vector<std::string>& commands) const {
        std::vector<std::thread> running;
        for (std::size_t i = 0; i < commands.size(); ++i)
            running.emplace_back([&, i] {
                const auto log = root_ / ("log-" + std::to_string(i));
                const int status = std::system(
                    (std::string(CLI_PROGRAM) + " " + commands[i] + " >" + log.string() + " 2>&1").c_str());
                EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << commands[i] << read(log);
            });
        for (auto& each : running) each.join();
    }
    projects::LoadedProject load() const { return projects::load_project(project, engine::registry()); }
    /// Every experiment knows its own result, which is listed, whole and current.
    void expect_all_kept(const std::vector<std::string>& experiments) const {
        const auto index = projects::ResultIndex::load(project);
        const auto damage = projects::check_results(index, project);
        EXPECT_TRUE(damage.empty()) << damage.front().text;
        const auto loaded = load();
        const auto now =
            projects::with_contents(loaded.project, projects::read_contents(loaded.project, project));
        for (const auto& each : experiments) {
            ASSERT_NE(projects::find_item(now.experiments, each), nullptr) << each;
            const auto& experiment = *projects::find_item(now.experiments, each);
            EXPECT_EQ(projects::result_state(now, experiment, engine::registry()),
                      projects::ResultState::current)
                << each;
            const auto* kept = index.find(experiment.last_kept_key);
            ASSERT_NE(kept, nullptr) << each;
            EXPECT_EQ(kept->experiment, each);
            EXPECT_NE(projects::file_of(*kept, projects::main_role), nullptr);
            EXPECT_NE(projects::file_of(*kept, projects::statistics_role), nullptr);
        }
    }

    fs::path root_, project;
};

TEST_F(ParallelKeeping, EightProcessesLoseNoneOfSixResultsEach) {
    constexpr int processes = 8, results = 6;
    make(processes * results, "view-normals");
    std::vector<std::string> commands, all;
    for (int p = 0; p < processes; ++p) {
        auto command = "render " + project.string() + " --keep --quiet --out " +
                       (root_ / ("out-" + std::to_string(p))).string();
        for (int i = 0; i < results; ++i) {
            all.push_back(id(p * results + i));
            command += " --experiment " + all.back();
        }
        commands.push_back(command);
    }
    // A window has the project, with changes that it saves while others keep results, and after.
    projects::OpenProject window(project, engine::registry());
    ASSERT_FALSE(window.is_read_only());
    window.edit(projects::edits::set_notes(window.project(), "first"));
    std::atomic<bool> have_ended = false;
    std::thread others([&] {
        run(commands);
        have_ended = true;
    });
    while (!fs::exists(project / "results/index.json") && !have_ended)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    window.save();
    window.edit(projects::edits::rename<projects::Experiment>(window.project(), id(7), "Seven"));
    others.join();
    window.save();

    EXPECT_EQ(projects::ResultIndex::load(project).entries().size(), all.size());
    expect_all_kept(all);
    const auto saved = load().project;
    EXPECT_EQ(saved.notes, "first");
    EXPECT_EQ(projects::find_item(saved.experiments, id(7))->name, "Seven");
    EXPECT_TRUE(window.set_last_kept(projects::ResultIndex::load(project).last_kept()));
    EXPECT_TRUE(window.stale_experiments().empty());
    EXPECT_FALSE(window.is_dirty());
}

/// Each adds a reference to the document, and keeps it.
TEST_F(ParallelKeeping, ReferencesOfDifferentExperimentsAreComputedAtTheSameTime) {
    constexpr int processes = 3;
    make(processes, "ldm-ao");
    auto json = Json::parse(read(project / "project.json"));
    for (int i = 0; i < processes; ++i) json["experiments"][i]["size"] = {16, 12 + i};
    std::ofstream(project / "project.json") << json.dump(1);
    std::vector<std::string> commands;
    for (int i = 0; i < processes; ++i)
        commands.push_back("reference " + project.string() + " --quiet --samples 16 --experiment " + id(i));
    run(commands);
    std::vector<std::string> references;
    const auto matched = load().project;
    for (int i = 0; i < processes; ++i)
        references.push_back(projects::find_item(matched.experiments, id(i))->reference);
    ASSERT_EQ(std::set<std::string>(references.begin(), references.end()).size(), 3u);
    expect_all_kept(references);

    // What is matched already needs no right to write the document.
    const projects::OpenProject window(project, engine::registry());
    ASSERT_FALSE(window.is_read_only());
    run({commands.front()});
    const auto log = root_ / "log";
    const auto status = std::system((std::string(CLI_PROGRAM) + " reference " + project.string() +
                                     " --samples 64 --quiet 2>" + log.string())
                                        .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_NE(read(log).find("has to be matched, but the project is open read-only"), std::string::npos)
        << read(log);
}

TEST_F(ParallelKeeping, AFolderThatCannotBeWrittenIsToldBeforeAnythingIsRendered) {
    make(1, "view-normals");
    std::ofstream(project / "results") << "in the way";
    const auto log = root_ / "log", out = root_ / "out";
    const auto status = std::system((std::string(CLI_PROGRAM) + " render " + project.string() +
                                     " --keep --quiet --out " + out.string() + " 2>" + log.string())
                                        .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_NE(read(log).find("cannot keep results: " + (project / "results").string()), std::string::npos)
        << read(log);
    EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace ir
