#include "projects/results.h"

#include <gtest/gtest.h>

#include <functional>

#include "projects/hash.h"
#include "projects/keep.h"
#include "projects/store.h"
#include "projects/sweep.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::registry;
using testing::sample_project;
using testing::TemporaryFolder;

std::string key_of(const Project& project) {
    return result_key(project, project.experiments[0], registry());
}

struct Change {
    const char* what;
    std::function<void(Project&)> apply;
};

TEST(ResultKey, ChangesWithEveryDependency) {
    const std::vector<Change> changes{
        {"content of the scene", [](Project& p) { p.scenes[0].parts[0].content_hash = "ff"; }},
        {"content of another part", [](Project& p) { p.scenes[0].parts[1].content_hash = "ff"; }},
        {"transform", [](Project& p) { (*p.scenes[0].parts[1].transform)[12] = 3; }},
        {"base colour of a material",
         [](Project& p) { p.scenes[0].parts[1].materials["gold"].base_colour->g = 0.5; }},
        {"another member of a material",
         [](Project& p) { p.scenes[0].parts[1].materials["gold"].metallic = 1; }},
        {"a member less", [](Project& p) { p.scenes[0].parts[1].materials["gold"].roughness.reset(); }},
        {"material", [](Project& p) { p.scenes[0].parts[1].materials.erase("candles"); }},
        {"material of another part",
         [](Project& p) { p.scenes[0].parts[0].materials["candles"].emission = glm::dvec3(1); }},
        {"other scene", [](Project& p) { p.experiments[0].scene = "room"; }},
        {"eye", [](Project& p) { p.motion[0].keys[0].eye.x += 1; }},
        {"target", [](Project& p) { p.motion[0].keys[1].target.y += 1; }},
        {"up", [](Project& p) { p.motion[0].keys[1].up.x += 1; }},
        {"position of a light", [](Project& p) { p.motion[1].keys[0].position->x += 1; }},
        {"target of a light", [](Project& p) { p.motion[1].keys[0].look_at->x += 1; }},
        {"intensity of a light", [](Project& p) { p.motion[1].keys[0].intensity = 2; }},
        {"key after the last frame", [](Project& p) { p.motion[1].keys[2].intensity = 2; }},
        {"loop", [](Project& p) { p.motion[1].loop = false; }},
        {"translation of a part", [](Project& p) { p.motion[2].keys[1].translation.y = 1; }},
        {"rotation of a part", [](Project& p) { p.motion[2].keys[1].rotation.y = 80; }},
        {"scale of a part", [](Project& p) { p.motion[2].keys[1].scale.z = 2; }},
        {"fewer motions", [](Project& p) { p.motion.pop_back(); }},
        {"field of view", [](Project& p) { p.cameras[0].fov_y_degrees = 41; }},
        {"projection", [](Project& p) { p.cameras[0].orthographic = true; }},
        {"camera of the scene", [](Project& p) { p.experiments[0].camera = "inside"; }},
        {"first camera", [](Project& p) { p.experiments[0].camera = ""; }},
        {"light", [](Project& p) { p.lights[0].lights[0].amount = 41; }},
        {"light's colour", [](Project& p) { p.lights[0].lights[1].color.x = 0.9; }},
        {"lights of the scene", [](Project& p) { p.experiments[0].lights = scene_lights; }},
        {"the scene's lights, too", [](Project& p) { p.lights[0].use_scene_lights = true; }},
        {"fewer lights", [](Project& p) { p.lights[0].lights.pop_back(); }},
        {"environment", [](Project& p) { p.lights[0].environment.constant.x = 1; }},
        {"environment's kind", [](Project& p) { p.lights[0].environment.kind = Environment::Kind::scene; }},
        {"method", [](Project& p) { p.experiments[0].method = "plain"; }},
        {"unknown method", [](Project& p) { p.experiments[0].method = "teleport"; }},
        {"value", [](Project& p) { p.experiments[0].values["density"] = 0.2; }},
        {"transport", [](Project& p) { p.experiments[0].values["max_distance"] = 2.0; }},
        {"overridden value",
         [](Project& p) { p.experiments[0].presets["paper"].values["samples"] = std::int64_t{2}; }},
        {"preset", [](Project& p) { p.experiments[0].active_preset = "preview"; }},
        {"size", [](Project& p) { p.experiments[0].presets["paper"].size = glm::ivec2(8, 8); }},
        {"seed", [](Project& p) { p.experiments[0].seed = 8; }},
        {"frames", [](Project& p) { p.experiments[0].frames = 5; }},
        {"time", [](Project& p) { p.experiments[0].time = 0.25; }},
    };
    std::map<std::string, std::string> seen{{key_of(sample_project()), "the sample"}};
    for (const auto& change : changes) {
        auto project = sample_project();
        change.apply(project);
        const auto [other, is_new] = seen.emplace(key_of(project), change.what);
        EXPECT_TRUE(is_new) << change.what << " gives the key of " << other->second;
    }
}

TEST(ResultKey, ChangesWithNothingElse) {
    const std::vector<Change> changes{
        {"names",
         [](Project& p) { p.name = p.experiments[0].name = p.scenes[0].name = p.cameras[0].name = "n"; }},
        {"notes", [](Project& p) { p.notes = p.experiments[0].notes = "n"; }},
        {"id of the experiment", [](Project& p) { p.experiments[0].id = "other"; }},
        {"id of the scene",
         [](Project& p) { p.scenes[0].id = p.experiments[0].scene = p.motion[2].scene = "other"; }},
        {"path of the scene", [](Project& p) { p.scenes[0].parts[0].source = "moved/church.glb"; }},
        {"reference", [](Project& p) { p.experiments[0].reference.clear(); }},
        {"kept key", [](Project& p) { p.experiments[0].last_kept_key = "k"; }},
        {"a preset that is not active", [](Project& p) { p.experiments[0].presets["preview"].frames = 9; }},
        {"an overridden value", [](Project& p) { p.experiments[0].values["samples"] = std::int64_t{3}; }},
        {"an overridden size",
         [](Project& p) {
             p.experiments[0].size = {3, 3};
         }},
        {"height of a perspective camera", [](Project& p) { p.cameras[0].height = 3; }},
        {"a pose that motion replaces", [](Project& p) { p.cameras[0].eye.x = 9; }},
        {"motions of something else",
         [](Project& p) {
             p.motion.push_back(p.motion[1]);
             p.motion.back().lights = "own";
             p.motion.push_back(p.motion[2]);
             p.motion.back().scene = "room";
         }},
        {"names of motions", [](Project& p) { p.motion[1].id = p.motion[1].name = "other"; }},
        {"unknown keys",
         [](Project& p) {
             p.scenes[0].parts[1].materials["gold"].extra["x"] = 1;
             p.scenes[0].parts[1].materials["silver"];  // changes nothing of it
             p.extra["x"] = p.experiments[0].extra["x"] = p.cameras[0].extra["x"] = 1;
             p.experiments[0].values["unknown"] = 1.0;
         }},
        {"the recorded method version", [](Project& p) { p.experiments[0].method_version = 2; }},
        {"other items",
         [](Project& p) {
             p.comparisons.clear();
             p.sweeps.clear();
             p.experiments.pop_back();
             p.lights.pop_back();
             p.images.clear();
         }},
    };
    const auto before = key_of(sample_project());
    for (const auto& change : changes) {
        auto project = sample_project();
        change.apply(project);
        EXPECT_EQ(key_of(project), before) << change.what;
    }
}

TEST(ResultKey, OfABuiltinSceneDependsOnItsNameVersionAndOptionsOnly) {
    auto project = sample_project();
    const auto key = [&] { return result_key(project, project.experiments[1], registry()); };
    auto& part = project.scenes[1].parts[0];
    const auto before = key();
    part.content_hash = "recorded later";
    EXPECT_EQ(key(), before);
    part.source = "builtin:room@2?side=4";
    EXPECT_NE(key(), before);
}

TEST(ResultKey, ChangesWithTheVersionOfTheMethod) {
    MethodDescription newer = registry().at("fog");
    newer.version = 4;
    const Registry other({&newer});
    const auto project = sample_project();
    EXPECT_NE(result_key(project, project.experiments[0], other), key_of(project));
}

TEST(ResultState, StaleMeansThatInputsChangedSinceKeeping) {
    auto project = sample_project();
    auto& e = project.experiments[0];
    EXPECT_EQ(result_state(project, e, registry()), ResultState::none);
    e.last_kept_key = key_of(project);
    EXPECT_EQ(result_state(project, e, registry()), ResultState::current);
    e.values["density"] = 3.0;
    EXPECT_EQ(result_state(project, e, registry()), ResultState::stale);
    e.values["density"] = 0.1;
    EXPECT_EQ(result_state(project, e, registry()), ResultState::current);
}

TEST(ResultState, DifferencesSayWhatChanged) {
    auto project = sample_project();
    const auto before = picture_inputs(project, project.experiments[0], registry());
    project.experiments[0].values["density"] = 3.0;
    project.experiments[0].seed = 8;
    const auto now = picture_inputs(project, project.experiments[0], registry());
    EXPECT_EQ(differences(before, now),
              (std::vector<std::string>{"values.density: 0.1 → 3.0", "seed: 7 → 8"}));
    EXPECT_TRUE(differences(now, now).empty());
}

KeptResult kept(const std::string& key, const std::string& file) {
    KeptResult result;
    result.key = key;
    result.experiment = "fog-nave";
    result.files = {{"main", file, hash_bytes("pixels")}};
    result.provenance = {"0.1", "driver 1", "egl", "2024-05-01T12:00:00Z"};
    result.provenance.processor = "host";
    result.inputs = {{"seed", 7}};
    return result;
}

TEST(ResultIndex, RoundTripsAndReplacesEqualKeys) {
    TemporaryFolder folder;
    EXPECT_TRUE(ResultIndex::load(folder.path()).entries().empty());
    ResultIndex index;
    index.put(kept("k1", "k1/main.exr"));
    index.put(kept("k2", "k2/main.exr"));
    index.put(kept("k1", "k1/other.exr"));
    ASSERT_EQ(index.entries().size(), 2u);
    index.save(folder.path());
    EXPECT_EQ(ResultIndex::load(folder.path()), index);
    EXPECT_EQ(index.find("k1")->files[0].path, "k1/other.exr");
    EXPECT_EQ(index.find("k3"), nullptr);
    EXPECT_TRUE(index.erase("k1"));
    EXPECT_FALSE(index.erase("k1"));
}

TEST(ResultIndex, RefusesPathsOutsideResults) {
    TemporaryFolder folder;
    ResultIndex index;
    for (const char* path : {"../project.json", "/etc/passwd", "a/../../b", "", "."}) {
        EXPECT_THROW(index.put(kept("k", path)), UsageError) << path;
        const Json json = {{"schema", 1}, {"entries", {{{"key", "k"}, {"files", {{{"path", path}}}}}}}};
        testing::write_text(folder.path() / "results/index.json", pretty_json(json));
        EXPECT_THROW(ResultIndex::load(folder.path()), InputError) << path;
    }
}

TEST(ResultIndex, CheckFindsMissingAndChangedFiles) {
    TemporaryFolder folder;
    ResultIndex index;
    index.put(kept("k1", "k1/main.exr"));
    EXPECT_NE(check_results(index, folder.path()).at(0).text.find("is missing"), std::string::npos);
    testing::write_text(folder.path() / "results/k1/main.exr", "pixels");
    EXPECT_TRUE(check_results(index, folder.path()).empty());
    testing::write_text(folder.path() / "results/k1/main.exr", "others");
    EXPECT_NE(check_results(index, folder.path()).at(0).text.find("was changed"), std::string::npos);
}

TEST(ResultIndex, PruneKeepsWhatExperimentsNeed) {
    TemporaryFolder folder;
    auto project = sample_project();
    const auto current = key_of(project);
    ResultIndex index;
    for (const auto& key : {current, std::string("last"), std::string("old")}) {
        index.put(kept(key, key + "/main.exr"));
        testing::write_text(folder.path() / "results" / key / "main.exr", "pixels");
    }
    testing::write_text(folder.path() / "results/stray.exr", "x");
    testing::write_text(folder.path() / "results" / sweep_path("counts") / "sweep.json", "{}");
    testing::write_text(folder.path() / "results" / sweep_path("gone") / "sweep.json", "{}");
    testing::write_text(folder.path() / "keep.txt", "outside");
    fs::create_symlink(folder.path() / "keep.txt", folder.path() / "results/link");
    index.set_last_kept("fog-nave", "last");
    index.save(folder.path());

    const auto pruned = prune_results(project, registry(), folder.path());
    EXPECT_EQ(pruned.keys, std::vector<std::string>{"old"});
    EXPECT_EQ(pruned.files,
              (std::vector<std::string>{"link", "old/main.exr", "stray.exr", "sweeps/gone/sweep.json"}));
    EXPECT_EQ(ResultIndex::load(folder.path()).entries().size(), 2u);
    EXPECT_TRUE(fs::exists(folder.path() / "results/last/main.exr"));
    EXPECT_TRUE(fs::exists(folder.path() / "results" / current / "main.exr"));
    EXPECT_TRUE(fs::exists(folder.path() / "results/sweeps/counts/sweep.json"))
        << "of a sweep of the project";
    EXPECT_FALSE(fs::exists(folder.path() / "results/old"));
    EXPECT_TRUE(fs::exists(folder.path() / "keep.txt"));
    EXPECT_TRUE(prune_results(project, registry(), folder.path()).files.empty());
}

/// A project of somebody else lists files that are none of its own, behind a link.
TEST(ResultLinks, NothingIsWrittenOrRemovedBehindThem) {
    TemporaryFolder root;
    const auto folder = root.path() / "a.interreflect", home = root.path() / "home";
    save_project(sample_project(), folder, "");
    testing::write_text(home / "thesis.tex", "years of work");
    ResultIndex index;
    KeptResult result;
    result.key = "k";
    result.files = {{"main", "k/thesis.tex", ""}};
    index.put(result);
    index.save(folder);
    fs::create_directory_symlink(home, folder / "results/k");
    EXPECT_THROW(delete_results(folder, {"k"}), Error);
    EXPECT_THROW(prune_results(load_project(folder, registry()).project, registry(), folder), Error);
    EXPECT_THROW(ResultsGuard{folder}, Error);
    EXPECT_EQ(testing::read_text(home / "thesis.tex"), "years of work");
    fs::remove(folder / "results/k");
    EXPECT_EQ(delete_results(folder, {"k"}).keys.size(), 1u);
}

}  // namespace
}  // namespace ir::projects
