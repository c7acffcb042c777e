#include "projects/open_project.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <functional>

#include "projects/check.h"
#include "projects/coordinate.h"
#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/sweep.h"
#include "renderers/core/error.h"
#include "renderers/core/shard.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::mentions;
using testing::registry;
using testing::sample_project;
using testing::TemporaryFolder;

/// The sample saved in a folder, with its scene files present and their hashes recorded.
class OpenProjectTest : public ::testing::Test {
  protected:
    OpenProjectTest() {
        testing::write_sample_files(folder);
        auto project = sample_project();
        for (auto& scene : project.scenes) scene = with_current_hashes(scene, folder);
        project.lights[1].environment.content_hash = hash_file(folder / "sky.exr");
        save_project(project, folder, "");
    }
    EditPtr density(const OpenProject& open, double value) {
        return edits::set_values(open.project(), registry(), "fog-nave", {{"density", value}});
    }
    TemporaryFolder temporary;
    fs::path folder = temporary.path() / "a.interreflect";
};

TEST_F(OpenProjectTest, EditsSavesAndOpensAgain) {
    {
        OpenProject open(folder / "project.json", registry());
        EXPECT_FALSE(open.is_read_only());
        EXPECT_FALSE(open.is_dirty());
        EXPECT_TRUE(open.edit(density(open, 0.7)));
        EXPECT_TRUE(open.is_dirty());
        open.save();
        EXPECT_FALSE(open.is_dirty());
        open.undo();
        EXPECT_TRUE(open.is_dirty());
        open.redo();
        EXPECT_FALSE(open.is_dirty());
    }
    OpenProject again(folder, registry());
    EXPECT_EQ(again.project().experiments[0].values.at("density"), Value{0.7});
}

/// A window has the project open and unsaved while commands keep results in it.
TEST_F(OpenProjectTest, WhatOthersKeepIsToldAndIsNoChangeOfTheDocument) {
    OpenProject open(folder, registry());
    open.edit(density(open, 0.7));
    const auto revision = open.undo_stack().position();
    KeptResult result;
    result.key = "key";
    result.experiment = "fog-nave";
    keep(folder, result, {}, ResultsGuard(folder));
    EXPECT_TRUE(open.set_last_kept(ResultIndex::load(folder).last_kept()));
    EXPECT_FALSE(open.set_last_kept(ResultIndex::load(folder).last_kept())) << "no news";
    const auto key = [&] { return open.project().experiments[0].last_kept_key; };
    EXPECT_EQ(key(), "key");
    EXPECT_EQ(open.undo_stack().position(), revision);
    open.undo();
    EXPECT_FALSE(open.is_dirty());
    EXPECT_EQ(key(), "key") << "kept results are no matter of undo";
    open.redo();
    EXPECT_EQ(key(), "key");
    open.save();  // nobody else changed the document

    OpenProject again(folder, registry());
    EXPECT_EQ(again.project().experiments[0].values.at("density"), Value{0.7});
    EXPECT_EQ(again.project().experiments[0].last_kept_key, "key");
    EXPECT_TRUE(mentions(again.messages(), "stale"));
    EXPECT_EQ(testing::read_text(folder / project_file_name).find("last_kept"), std::string::npos);
    testing::write_text(folder / "results/index.json", "damaged");
    EXPECT_EQ(load_project(folder, registry()).project.experiments[0].last_kept_key, "");
}

TEST_F(OpenProjectTest, ANewExperimentNeverComesWithTheResultOfARemovedOne) {
    OpenProject open(folder, registry());
    const auto duplicate = [&] {
        open.edit(edits::duplicate<Experiment>(open.project(), "fog-nave"));
        return open.project().experiments[1];
    };
    const auto first = duplicate().id;
    KeptResult result;
    result.key = "key";
    result.experiment = first;
    keep(folder, result, {}, ResultsGuard(folder));
    open.set_last_kept(ResultIndex::load(folder).last_kept());
    EXPECT_EQ(find_item(open.project().experiments, first)->last_kept_key, "key");
    open.edit(edits::remove<Experiment>(open.project(), first));
    open.save();

    EXPECT_EQ(duplicate().last_kept_key, "");
    auto fresh = edits::new_experiment(open.project(), registry(), "plain", first, "", "");
    open.edit(edits::add(open.project(), fresh));
    EXPECT_EQ(find_item(open.project().experiments, fresh.id)->last_kept_key, "");
    for (int steps = 0; steps < 3; ++steps) open.undo();
    ASSERT_NE(find_item(open.project().experiments, first), nullptr);
    EXPECT_EQ(find_item(open.project().experiments, first)->last_kept_key, "key") << "it finds its own";

    const auto saved = load_project(folder, registry()).project;
    EXPECT_EQ(find_item(saved.experiments, first), nullptr);
    EXPECT_NE(edits::new_experiment(saved, registry(), "plain", first, "", "").id, first);
}

TEST_F(OpenProjectTest, WhatProcessesThatEndedLeftHalfWrittenGoesWithTheLock) {
    const auto ended = fork();
    if (ended == 0) _exit(0);
    ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
    const auto left = folder / ("project.json." + std::to_string(ended) + "-1.tmp");
    testing::write_text(folder / "notes.tmp", "a person's own");
    testing::write_text(left, "half");
    const auto results_left = folder / "results" / left.filename();
    testing::write_text(results_left, "half");
    {
        const auto lock = Lock::acquire(folder);
        const OpenProject second(folder, registry());
        EXPECT_TRUE(fs::exists(left)) << "whoever has the lock may be on another machine";
    }
    const OpenProject open(folder, registry());
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(folder / "notes.tmp"));
    EXPECT_TRUE(fs::exists(results_left)) << "that is for who has the guard";
}

TEST_F(OpenProjectTest, TheSecondOpensReadOnly) {
    OpenProject first(folder, registry());
    OpenProject second(folder, registry());
    EXPECT_TRUE(second.is_read_only());
    EXPECT_NE(second.read_only_reason(), "");
    EXPECT_THROW(second.edit(density(second, 1)), UsageError);
    EXPECT_THROW(second.save(), UsageError);
    second.save_as(temporary.path() / "b");
    EXPECT_FALSE(second.is_read_only());
    EXPECT_TRUE(second.edit(density(second, 1)));
    EXPECT_FALSE(first.is_read_only());
}

TEST_F(OpenProjectTest, ABrokenLockStopsTheFirstFromSaving) {
    OpenProject first(folder, registry());
    first.edit(density(first, 0.9));
    OpenProject second(folder, registry());
    testing::write_text(folder / ".lock", "{\"host\": \"elsewhere\", \"pid\": 3}");
    EXPECT_THROW(first.save(), Error);
    second.break_lock();
    EXPECT_FALSE(second.is_read_only());
}

TEST_F(OpenProjectTest, CrashedSessionsAreRecovered) {
    {
        OpenProject crashed(folder, registry());
        crashed.edit(density(crashed, 0.9));
        crashed.autosave();
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!fs::exists(folder / autosave_file_name) && std::chrono::steady_clock::now() < deadline)
            std::this_thread::yield();
    }  // without close(): as after a crash
    {
        OpenProject open(folder, registry());
        ASSERT_TRUE(open.recovery());
        EXPECT_EQ(open.project().experiments[0].values.at("density"), Value{0.1});
        open.take_recovery();
        EXPECT_EQ(open.project().experiments[0].values.at("density"), Value{0.9});
        EXPECT_TRUE(open.is_dirty());
        open.save();
    }
    OpenProject after(folder, registry());
    EXPECT_FALSE(after.recovery());
    EXPECT_EQ(after.project().experiments[0].values.at("density"), Value{0.9});
    after.edit(density(after, 0.2));
    after.autosave();
    after.close();
    EXPECT_FALSE(fs::exists(folder / autosave_file_name));
    EXPECT_FALSE(fs::exists(folder / ".lock"));
}

TEST_F(OpenProjectTest, SaveAsMovesSourcesAndCopiesResults) {
    testing::write_text(folder / "results/k/main.exr", "pixels");
    OpenProject open(folder, registry());
    open.save_as(temporary.path() / "deep/er/copy");
    const auto target = temporary.path() / "deep/er/copy.interreflect";
    EXPECT_EQ(open.folder(), target);
    EXPECT_EQ(open.project().scenes[0].parts[0].source, "../../../a.interreflect/scenes/church.glb");
    EXPECT_EQ(open.project().scenes[1].parts[0].source, "builtin:room@1?side=4");
    EXPECT_FALSE(mentions(open.messages(), "missing"));
    EXPECT_EQ(testing::read_text(target / "results/k/main.exr"), "pixels");
    EXPECT_TRUE(Lock::acquire(folder).is_held());  // the old folder is free again
}

TEST_F(OpenProjectTest, NewProjectsGetTheirFolderLater) {
    OpenProject open(registry());
    EXPECT_TRUE(open.edit(edits::set_notes(open.project(), "n")));
    EXPECT_THROW(open.save(), UsageError);
    open.autosave();
    open.save_as(temporary.path() / "fresh");
    EXPECT_EQ(load_project(temporary.path() / "fresh.interreflect", registry()).project.name, "fresh");
}

TEST_F(OpenProjectTest, StepsBeforeTheFirstSavingCanBeUndone) {
    OpenProject open(with_absolute_sources(sample_project(), folder), registry());
    const auto notes = open.project().notes;
    open.edit(edits::set_notes(open.project(), "n"));
    open.save_as(temporary.path() / "begun");
    EXPECT_EQ(open.project().scenes[0].parts[0].source, "../a.interreflect/scenes/church.glb");
    ASSERT_TRUE(open.undo_stack().can_undo());
    open.undo();
    EXPECT_EQ(open.project().notes, notes);
    EXPECT_TRUE(open.is_dirty());
    open.redo();
    EXPECT_FALSE(open.is_dirty());
}

TEST_F(OpenProjectTest, WhatANewProjectBeginsWithIsUnsavedAndCannotBeUndone) {
    OpenProject open(sample_project(), registry());
    EXPECT_EQ(open.project(), sample_project());
    EXPECT_TRUE(open.folder().empty());
    EXPECT_TRUE(open.is_dirty());
    EXPECT_FALSE(open.undo_stack().can_undo());
    open.edit(edits::set_notes(open.project(), "n"));
    open.undo();
    EXPECT_TRUE(open.is_dirty());
    open.save_as(temporary.path() / "begun");
    EXPECT_FALSE(open.is_dirty());
}

TEST_F(OpenProjectTest, MissingAndChangedScenesOpenWithMessages) {
    fs::remove(folder / "scenes/church.glb");
    testing::write_text(folder / "scenes/organ.glb", "another organ");
    testing::write_text(folder / "moved.glb", "content of scenes/church.glb");
    OpenProject open(folder, registry());
    open.wait_for_files();
    EXPECT_TRUE(mentions(open.messages(), "'scenes/church.glb' is missing"));
    EXPECT_EQ(open.messages()[0].severity, Severity::error);
    EXPECT_TRUE(mentions(open.messages(), "'scenes/organ.glb' is not the file that was recorded"));
    EXPECT_NE(why_not_runnable(open.project(), open.project().experiments[0], registry(), folder), "");
    EXPECT_EQ(why_not_runnable(open.project(), open.project().experiments[1], registry(), folder), "");

    const auto found = located(open.project().scenes[0], 0, folder / "moved.glb", folder);
    EXPECT_EQ(found.parts[0].source, "moved.glb");
    open.edit(edits::change(open.project(), found));
    open.edit(edits::change(open.project(), with_current_hashes(found, folder)));
    open.check_again();
    EXPECT_FALSE(mentions(open.messages(), "missing"));
    EXPECT_FALSE(mentions(open.messages(), "not the file"));
    EXPECT_EQ(why_not_runnable(open.project(), open.project().experiments[0], registry(), folder), "");
}

TEST_F(OpenProjectTest, CheckReportsUnknownThings) {
    auto project = load_project(folder, registry()).project;
    project.extra["mood"] = 1;
    project.experiments[0].method = "teleport";
    save_project(project, folder, "");
    OpenProject open(folder, registry());
    EXPECT_TRUE(mentions(open.messages(), "unknown key /mood"));
    EXPECT_TRUE(mentions(open.messages(), "method 'teleport' is unknown"));
    EXPECT_NE(why_not_runnable(open.project(), open.project().experiments[0], registry(), folder), "");
}

/// Each names the file, the place and the mend, and is an error: it cannot work.
TEST_F(OpenProjectTest, CheckFindsReferencesToNothing) {
    const auto good = load_project(folder, registry()).project;
    const auto errors = [&](const Project& project) {
        std::vector<std::string> lines;
        for (const auto& message : check({project, schema_version, {}}, folder, registry()))
            if (message.severity == Severity::error) lines.push_back(message.text);
        return lines;
    };
    EXPECT_EQ(errors(good), std::vector<std::string>());
    const auto motion_of = [](Project& project, Motion::Kind kind) -> Motion& {
        return *std::find_if(project.motion.begin(), project.motion.end(),
                             [&](const Motion& motion) { return motion.kind == kind; });
    };
    struct Case {
        const char *place, *text;
        std::function<void(Project&)> damage;
    };
    const std::vector<Case> cases{
        {"/experiments/1/scene", "there is no scene 'gone'",
         [](auto& p) { p.experiments[1].scene = "gone"; }},
        {"/experiments/1/scene", "has no scene", [](auto& p) { p.experiments[1].scene.clear(); }},
        {"/experiments/1/camera", "there is no camera 'gone'",
         [](auto& p) { p.experiments[1].camera = "gone"; }},
        {"/experiments/1/lights", "there is no set of lights 'gone'",
         [](auto& p) { p.experiments[1].lights = "gone"; }},
        {"/experiments/1/reference", "there is no experiment 'gone'",
         [](auto& p) { p.experiments[1].reference = "gone"; }},
        {"/camera", "there is no camera 'gone'",
         [&](auto& p) { motion_of(p, Motion::Kind::camera).camera = "gone"; }},
        {"/lights", "there is no set of lights 'gone'",
         [&](auto& p) {
             auto& motion = motion_of(p, Motion::Kind::light);
             motion.lights = "gone", motion.light_name = "lamp";
         }},
        {"/light", "there is no light 99",
         [&](auto& p) {
             auto& motion = motion_of(p, Motion::Kind::light);
             motion.light = 99, motion.light_name.clear(), motion.lights = p.lights[0].id;
         }},
        {"/scene", "there is no scene 'gone'",
         [&](auto& p) { motion_of(p, Motion::Kind::part).scene = "gone"; }},
        {"/part", "there is no part 99", [&](auto& p) { motion_of(p, Motion::Kind::part).part = 99; }},
        {"/comparisons/0/a", "there is no experiment or image 'gone'",
         [](auto& p) { p.comparisons[0].a = "gone"; }},
        {"/sweeps/0/experiment", "there is no experiment 'gone'",
         [](auto& p) { p.sweeps[0].experiment = "gone"; }},
        {"/sweeps/0/experiment", "has no experiment", [](auto& p) { p.sweeps[0].experiment.clear(); }},
        {"/comparisons/0/a", "has no picture", [](auto& p) { p.comparisons[0].a.clear(); }},
        {"/comparisons/0/b", "has no picture", [](auto& p) { p.comparisons[0].b.clear(); }},
        {"/plots/0/reference", "there is no experiment or image 'gone'",
         [](auto& p) { p.plots[0].reference = "gone"; }},
        {"/plots/0/experiments", "there is no experiment 'gone'",
         [](auto& p) { p.plots[0].experiments.push_back("gone"); }},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(std::string(one.place) + " " + one.text);
        auto project = good;
        one.damage(project);
        const auto found = errors(project);
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].find((folder / project_file_name).string() + ": /"), 0u) << found[0];
        EXPECT_NE(found[0].find(std::string(one.place) + ": "), std::string::npos) << found[0];
        EXPECT_NE(found[0].find(one.text), std::string::npos) << found[0];
        EXPECT_NE(found[0].find("; "), std::string::npos) << "the mend: " << found[0];
        EXPECT_EQ(found[0].find('\n'), std::string::npos) << found[0];
    }
}

TEST(SceneFiles, HashesCoverWhatGltfRefersTo) {
    TemporaryFolder temporary;
    const auto file = temporary.path() / "a.gltf";
    testing::write_text(file, R"({"buffers": [{"uri": "a%20b.bin"}, {"uri": "data:xyz"}],
                                  "images": [{"uri": "t.png"}], "extras": {"uri": "no.bin"}})");
    testing::write_text(temporary.path() / "a b.bin", "1");
    testing::write_text(temporary.path() / "t.png", "2");
    EXPECT_EQ(files_of(file),
              (std::vector<fs::path>{file, temporary.path() / "a b.bin", temporary.path() / "t.png"}));
    const auto before = scene_hash("a.gltf", temporary.path());
    EXPECT_EQ(scene_hash(file.string(), "/"), before);
    testing::write_text(temporary.path() / "a b.bin", "3");
    EXPECT_NE(scene_hash("a.gltf", temporary.path()), before);
    fs::remove(temporary.path() / "a b.bin");
    EXPECT_NE(scene_hash("a.gltf", temporary.path()), before);
    EXPECT_THROW(scene_hash("none.glb", temporary.path()), InputError);
    EXPECT_THROW(hash_file("/dev/zero"), InputError);
    EXPECT_TRUE(files_of("/none.gltf").size() == 1);
}

TEST_F(OpenProjectTest, MissingHashesAreRecordedOnRequest) {
    auto project = load_project(folder, registry()).project;
    const auto recorded = project.scenes[0].parts[1].content_hash;
    project.scenes[0].parts[0].content_hash.clear();
    project.scenes[0].parts[1].content_hash = "of another file";
    const auto hashed = with_missing_hashes(project, folder);
    EXPECT_EQ(hashed.scenes[0].parts[0].content_hash, hash_file(folder / "scenes/church.glb"));
    EXPECT_EQ(hashed.scenes[0].parts[1].content_hash, "of another file");  // that is for the user to accept
    EXPECT_EQ(hashed.images[0].content_hash, hash_file(folder / "photo.exr"));
    EXPECT_NE(recorded, "of another file");
}

TEST(SceneFiles, BuiltinScenesHashByNameVersionAndOptions) {
    EXPECT_EQ(scene_hash("builtin:a@1?x=1&y=2", ""), scene_hash("builtin:a@1?y=2&x=1", ""));
    EXPECT_NE(scene_hash("builtin:a@1", ""), scene_hash("builtin:a@2", ""));
    EXPECT_NE(scene_hash("builtin:a@1", ""), scene_hash("builtin:a@1?x=1", ""));
    EXPECT_EQ(loadable_source("builtin:a@1", "/x"), "builtin:a@1");
    EXPECT_EQ(loadable_source("../s/a.glb", "/x/p"), "/x/s/a.glb");
    EXPECT_EQ(relative_source("/x/s/a.glb", "/x/p"), "../s/a.glb");
}

TEST(Sweeps, AreTheProductOfTheirAxes) {
    const auto project = sample_project();
    const auto points = sweep_points(project, project.sweeps[0], registry());
    ASSERT_EQ(points.size(), 6u);
    EXPECT_EQ(check_sweep(project, project.sweeps[0], registry()), 6u);
    EXPECT_EQ(points[0].coordinates, Json({{"samples", 1}, {"seed", 1}}));
    EXPECT_EQ(points[1].coordinates, Json({{"samples", 1}, {"seed", 2}}));
    EXPECT_EQ(points[4].experiment.values.at("samples"), Value{std::int64_t{16}});
    EXPECT_EQ(points[5].experiment.seed, 2u);
    EXPECT_EQ(points[5].experiment.id, "fog-nave-0006");
    EXPECT_EQ(points[5].experiment.size, glm::ivec2(1024, 1024));  // the active preset's

    std::vector<std::string> ids;
    for (int i = 1; i <= 4; ++i)
        for (const auto& point : part_of(points, {i, 4})) ids.push_back(point.experiment.id);
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(ids.size(), 6u);
    EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
}

TEST(Sweeps, RefuseWhatCannotRun) {
    const auto project = sample_project();
    const auto refused = [&](const Sweep::Axis& axis) {
        Sweep sweep = project.sweeps[0];
        sweep.axes.push_back(axis);
        EXPECT_THROW(sweep_points(project, sweep, registry()), UsageError) << axis.key;
        EXPECT_THROW(check_sweep(project, sweep, registry()), UsageError) << axis.key;
    };
    refused({"smaples", {1}});
    refused({"density", {-1}});
    refused({"density", {Json::array()}});
    refused({"density", {}});
    refused({"camera", {"gone"}});
    refused({"size", {{0, 1}}});
    refused({"seed", {-1}});
    refused({"frames", {0}});
    refused({"time", std::vector<Json>(99999, 0.5)});
}

TEST(Sweeps, AVariationsValuesBecomeTheExperimentsInOneStep) {
    auto project = sample_project();
    const auto before = project;
    const Json coordinates{{"samples", 16},
                           {"seed", 9},
                           {"frames", 3},
                           {"size", {32, 24}},
                           {"time", 0.5},
                           {"lights", scene_lights},
                           {"camera", project.cameras[0].id}};
    auto edit = edits::set_coordinates(project, registry(), "fog-nave", coordinates, "Load it");
    EXPECT_EQ(edit->label(), "Load it");
    EXPECT_EQ(project, before) << "an edit that is made changes nothing";
    edit->apply(project);
    const auto now = effective(*find_item(project.experiments, "fog-nave"));
    EXPECT_EQ(now.values.at("samples"), Value{std::int64_t{16}});
    EXPECT_EQ(now.seed, 9u);
    EXPECT_EQ(now.frames, 3);
    EXPECT_EQ(now.size, glm::ivec2(32, 24));
    EXPECT_EQ(now.time, 0.5);
    EXPECT_EQ(now.lights, scene_lights);
    EXPECT_EQ(now.camera, project.cameras[0].id);
    edit->revert(project);
    EXPECT_EQ(project, before);
    EXPECT_THROW(edits::set_coordinates(project, registry(), "gone", coordinates, ""), UsageError);
    EXPECT_THROW(edits::set_coordinates(project, registry(), "fog-nave", {{"smaples", 1}}, ""), UsageError);
}

}  // namespace
}  // namespace ir::projects
