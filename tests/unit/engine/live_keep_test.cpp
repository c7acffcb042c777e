// Results kept from the render thread: what is shown, with its state, while a window goes on.
#include <filesystem>
#include <fstream>

#include "app/engine/from_project.h"
#include "projects/edits.h"
#include "projects/results.h"
#include "projects/samples.h"
#include "projects/store.h"
#include "tests/own_folder.h"
#include "tests/unit/engine/render_thread_fixture.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

class LiveKeepTest : public RenderThreadTest {
  protected:
    void SetUp() override {
        const auto* reference = registry().reference();
        if (!reference) GTEST_SKIP() << "this build has no method that accumulates";
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder = own_folder("keep-" + std::string(test->name()));
        fs::remove_all(folder);
        project.scenes = {{"box", "Box", {{"builtin:cornell@1", "", {}}}}};
        auto experiment =
            projects::edits::new_experiment(project, registry(), reference->id, "Truth", "box", "");
        experiment.size = {16, 12};
        experiment.frames = 2;
        project.experiments = {projects::with_sample_count(experiment, 8, registry())};
        projects::save_project(project, folder, "");
        RenderThreadTest::SetUp();
    }
    void TearDown() override {
        RenderThreadTest::TearDown();
        fs::remove_all(folder);
    }
    projects::Experiment& truth() { return project.experiments[0]; }
    LiveRequest request(const std::string& state_file = {}) {
        LiveRequest request;
        request.tag = truth().id;
        request.experiment = from_project(project, truth(), folder);
        request.parts = {Part{}};
        request.state_file = state_file;
        return request;
    }
    KeepResult keep() {
        forget();
        thread->keep({truth().id, project, truth().id, folder.string()});
        EXPECT_TRUE(wait([](const Answers& a) { return !a.keeps.empty(); }));
        return answers().keeps.empty() ? KeepResult() : answers().keeps.front();
    }
    fs::path folder;
    projects::Project project;
};

TEST_F(LiveKeepTest, KeepsPictureAndStateUnderTheKeyOfTheExperiment) {
    EXPECT_NE(keep().error, "") << "nothing is rendered";
    render(request());
    const auto kept = keep();
    EXPECT_EQ(kept.error, "");
    EXPECT_EQ(kept.tag, truth().id);
    EXPECT_EQ(kept.key, projects::result_key(project, truth(), registry()));
    const auto index = projects::ResultIndex::load(folder);
    ASSERT_NE(index.find(kept.key), nullptr);
    EXPECT_EQ(index.find(kept.key)->samples, 8u);
    EXPECT_NE(index.find_state(projects::state_key(project, truth(), registry())), nullptr);
    EXPECT_TRUE(projects::check_results(index, folder).empty());
}

/// Projects may come from anybody.
TEST_F(LiveKeepTest, LinksInTheProjectAreReplacedAndNotFollowed) {
    render(request());
    const auto key = projects::result_key(project, truth(), registry());
    const auto results = folder / "results" / projects::result_folder(key);
    const auto elsewhere = folder / "elsewhere";
    std::ofstream(elsewhere) << "a person's own";
    fs::create_directories(results);
    const auto names = {"main.exr", "statistics.json", "state.exr"};
    for (const char* name : names) fs::create_symlink(elsewhere, results / name);
    EXPECT_EQ(keep().error, "");
    for (const char* name : names) EXPECT_FALSE(fs::is_symlink(results / name)) << name;
    EXPECT_EQ(fs::file_size(elsewhere), std::string("a person's own").size());
    EXPECT_TRUE(projects::check_results(projects::ResultIndex::load(folder), folder).empty());
}

TEST_F(LiveKeepTest, GoesOnFromWhatWasKeptAndSaysSo) {
    render(request());
    auto kept = keep();
    auto index = projects::ResultIndex::load(folder);
    const auto* state = projects::file_of(*index.find(kept.key), projects::state_role);
    ASSERT_NE(state, nullptr);
    const auto file = (folder / "results" / state->path).string();
    truth() = projects::with_sample_count(truth(), 32, registry());
    thread->release(truth().id);
    render(request(file));
    kept = keep();
    EXPECT_EQ(kept.error, "");
    index = projects::ResultIndex::load(folder);
    const auto* grown = index.find(kept.key);
    ASSERT_NE(grown, nullptr);
    EXPECT_EQ(grown->samples, 32u);
    ASSERT_TRUE(grown->provenance.extra.contains("resumed_from"));
    EXPECT_EQ(grown->provenance.extra["resumed_from"][0]["samples"], 8);
    EXPECT_FALSE(fs::exists(file)) << "a state with more samples takes its place";
    // Fewer samples are served by the larger state.
    truth() = projects::with_sample_count(truth(), 4, registry());
    const auto shown = render(request());
    EXPECT_EQ(shown.frame, shown.frames);
    kept = keep();
    EXPECT_EQ(kept.key, projects::result_key(project, truth(), registry()));
    index = projects::ResultIndex::load(folder);
    EXPECT_EQ(index.find(kept.key)->samples, 32u);
    EXPECT_TRUE(projects::check_results(index, folder).empty());
}

TEST_F(LiveKeepTest, WhatIsNotShownIsNotKept) {
    render(request());
    truth().seed = 99;
    EXPECT_NE(keep().error.find("wait until it is rendered"), std::string::npos);
    project.experiments.clear();
    forget();
    thread->keep({"truth", project, "truth", folder.string()});
    ASSERT_TRUE(wait([](const Answers& a) { return !a.keeps.empty(); }));
    EXPECT_NE(answers().keeps[0].error, "");
    EXPECT_FALSE(fs::exists(folder / "results"));
}

}  // namespace
}  // namespace ir::engine
