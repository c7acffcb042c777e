// Every method beside its matched reference in every scene: no light is in one picture alone without a word.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "app/engine/execution.h"
#include "app/engine/moving.h"
#include "projects/document.h"
#include "projects/match.h"
#include "renderers/core/light_use.h"
#include "tests/light_variants.h"

namespace ir::engine {
namespace {

using projects::Project;

/// Built-in scenes, and those of INTERREFLECT_SCENES that are rooms or one file, where it is set.
std::vector<std::string> all_scenes() {
    std::vector<std::string> result;
    for (const auto& name : scene::builtin_names()) result.push_back("builtin:" + name);
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) return result;
    namespace fs = std::filesystem;
    const auto add = [&](const fs::directory_entry& entry) {
        if (entry.path().extension() == ".glb") result.push_back(entry.path().string());
    };
    for (const auto& entry : fs::directory_iterator(folder)) add(entry);
    for (const char* part : {"rooms", "cornell"})
        if (const auto rooms = fs::path(folder) / part; fs::is_directory(rooms))
            for (const auto& entry : fs::recursive_directory_iterator(rooms)) add(entry);
    return result;
}

/// The defaults, and what changes which light a method has.
std::vector<Settings> variants_of(const MethodDescription& method) {
    std::vector<Settings> result;
    for (const auto& paths : find(method.parameters, "paths")->supported)
        for (auto settings : test::light_variants(method)) {
            settings["paths"] = paths;
            result.push_back(std::move(settings));
        }
    return result;
}

Project project_of(const std::string& scene, const MethodDescription& method, const Settings& settings) {
    Project project;
    project.scenes = {{"scene", "Scene", {{scene, "", {}}}}};
    projects::Experiment experiment;
    experiment.id = "picture";
    experiment.scene = "scene";
    experiment.method = method.id;
    experiment.values = completed(method.parameters, settings);
    project.experiments = {experiment};
    return project;
}

std::vector<UsedLight> lights_of(const projects::Experiment& experiment,
                                 const std::vector<LightSource>& sources) {
    const auto& method = registry().at(experiment.method);
    return used_lights(sources, light_use(method, projects::runnable_settings(experiment, method)));
}

TEST(LightSources, DifferNowhereWithoutAWord) {
    SceneCache cache;
    int combinations = 0, told = 0, sources_seen = 0;
    for (const auto& scene : all_scenes())
        for (const auto* method : registry().methods()) {
            const auto* parameter = find(method->parameters, "paths");
            if (!parameter || method->is_reference) continue;
            for (const auto& settings : variants_of(*method)) {
                auto project = project_of(scene, *method, settings);
                const auto paths = std::get<std::string>(settings.at("paths"));
                const auto facts = scene_facts(cache, project, ".");
                const auto sources = facts.light_sources(project.experiments[0]);
                projects::match(project, "picture", registry(), facts.is_animated)->apply(project);
                const auto& truth =
                    *projects::find_item(project.experiments, project.experiments[0].reference);
                const auto differences =
                    light_differences(lights_of(project.experiments[0], sources), lights_of(truth, sources),
                                      light_parts_of(paths), "the picture", "the reference");
                const auto words = projects::mismatched_references(project, registry(), facts);
                ASSERT_EQ(words.empty(), differences.empty())
                    << scene << " " << method->id << " " << paths << ", " << settings.size() - 1
                    << " more settings";
                if (!words.empty()) {
                    EXPECT_NE(words[0].second.find(differences[0]), std::string::npos) << words[0].second;
                }
                ++combinations;
                told += !words.empty();
                sources_seen += !sources.empty();
            }
        }
    EXPECT_GT(combinations, 100);
    EXPECT_GT(sources_seen, 100);
    // What remains is told, and is little: sources that a method has in part.
    EXPECT_GT(told, 0);
    EXPECT_LT(told, combinations / 4);
    RecordProperty("combinations", combinations);
    RecordProperty("told", told);
}

}  // namespace
}  // namespace ir::engine
