#include "projects/match.h"

#include <gtest/gtest.h>

#include "projects/results.h"
#include "projects/samples.h"
#include "projects/undo_stack.h"
#include "renderers/core/error.h"
#include "renderers/core/transport.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::sample_project;

struct TruthSettings {
    int samples = 16;
    bool antialias = false;
    Transport transport{.paths = Transport::Paths::full, .max_distance = 5};
};

/// A ground truth with other defaults than "fog", which has no bounces and no materials.
const MethodDescription& truth() {
    static const MethodDescription method = [] {
        ParameterTable<TruthSettings> table;
        table.add(&TruthSettings::samples,
                  {.key = "samples", .label = "Samples", .doc = "", .hard = {1, 1e6}, .accumulates = true});
        table.add(&TruthSettings::antialias, {.key = "antialias", .label = "Antialias", .doc = ""});
        table.include(&TruthSettings::transport,
                      transport_parameters({{"ao", "full"},
                                            {"max_distance", "falloff", "max_bounces", "normal_maps",
                                             "environment_light", "emitters"}}));
        MethodDescription result;
        result.id = "truth";
        result.title = "Truth";
        result.parameters = table.descriptions();
        result.is_reference = true;
        return result;
    }();
    return method;
}

const Registry& foggy_methods() {
    static const Registry all({&testing::registry().at("fog"), &testing::registry().at("plain"), &truth()});
    return all;
}

/// Scenes whose files animate nothing, or something.
bool still(const std::string&) {
    return false;
}
bool animated(const std::string&) {
    return true;
}

Project unmatched() {
    auto project = sample_project();
    project.experiments[0].reference.clear();
    return project;
}

const Experiment& reference_of(const Project& project, std::size_t i = 0) {
    return *find_item(project.experiments, project.experiments[i].reference);
}

/// Applies it as one step and returns the stack to undo it by.
/// Of the experiment that match() takes or adds.
std::string match_id(Project project, const std::string& id, const AnimatedScene& is_animated) {
    if (const auto edit = match(project, id, foggy_methods(), is_animated)) edit->apply(project);
    return find_item(project.experiments, id)->reference;
}

UndoStack matched(Project& project, const std::string& id) {
    UndoStack stack;
    EXPECT_TRUE(stack.push(project, match(project, id, foggy_methods(), still)));
    return stack;
}

TEST(Match, CopiesWhatTheTruthDependsOnAndNothingElse) {
    auto project = unmatched();
    project.experiments[0].values["max_distance"] = 2.5;
    matched(project, "fog-nave");
    const auto& found = reference_of(project);
    EXPECT_EQ(found.name, "Fog in the nave reference");
    EXPECT_EQ(found.method, "truth");
    EXPECT_EQ(&found, &project.experiments[1]) << "behind its experiment";
    EXPECT_EQ(found.scene, "church");
    EXPECT_EQ(found.camera, "orbit");
    EXPECT_EQ(found.lights, "evening");
    EXPECT_EQ(found.size, glm::ivec2(1024, 1024)) << "of the active preset";
    EXPECT_DOUBLE_EQ(found.time, 0.5 + 3 / 30.0);  // of the last of 4 frames, wherever the camera is then
    EXPECT_EQ(found.values.at("max_distance"), Value{2.5});
    EXPECT_EQ(found.values.at("paths"), Value{std::string("ao")}) << "the method's default, not the truth's";
    EXPECT_EQ(found.values.at("samples"), Value{std::int64_t{16}}) << "no transport";
    EXPECT_EQ(found.values.count("density"), 0u);
    EXPECT_EQ(found.values.at("normal_maps"), Value{true}) << "unknown to the method: the truth's default";
    EXPECT_TRUE(found.presets.empty());
    EXPECT_GT(found.frames, 1) << "a first picture is there soon";
    EXPECT_TRUE(mismatched_references(project, foggy_methods(), {still}).empty());
}

TEST(Match, CompletesTheValuesThatAnExperimentLacks) {
    auto project = unmatched();
    project.experiments[0].values.erase("max_distance");
    matched(project, "fog-nave");
    EXPECT_EQ(reference_of(project).values.at("max_distance"), Value{0.0})
        << "fog's default, not the truth's 5";
}

TEST(Match, IsOneStepOfUndo) {
    auto project = unmatched();
    const auto before = project;
    auto stack = matched(project, "fog-nave");
    const auto after = project;
    stack.undo(project);
    EXPECT_EQ(project, before);
    stack.redo(project);
    EXPECT_EQ(project, after);
    EXPECT_EQ(match(project, "fog-nave", foggy_methods(), still), nullptr) << "it is matched already";
}

TEST(Match, SharesATruthAtAnyNumberOfSamplesAndSeed) {
    auto project = unmatched();
    auto copy = project.experiments[0];
    copy.id = "copy";
    copy.values["density"] = 7.0;
    project.experiments.push_back(copy);
    matched(project, "fog-nave");
    auto& first = project.experiments[1];
    first = with_sample_count(first, 4096, foggy_methods());
    first.seed = 99;
    EXPECT_EQ(match_id(project, "copy", still), first.id);
    matched(project, "copy");
    EXPECT_EQ(project.experiments.size(), 4u);
    EXPECT_EQ(find_item(project.experiments, "copy")->reference, first.id);
    // What tells truths apart tells references apart.
    first.values["antialias"] = true;
    EXPECT_NE(match_id(project, "copy", still), first.id);
    find_item(project.experiments, "copy")->values["max_distance"] = 1.0;
    matched(project, "copy");
    EXPECT_EQ(project.experiments.size(), 5u);
}

TEST(Match, WhatDoesNotCountTellsNoTruthsApart) {
    auto project = unmatched();
    matched(project, "fog-nave");
    EXPECT_EQ(reference_of(project).values.at("max_bounces"), Value{std::int64_t{1}});
    project.experiments[1].values["max_bounces"] = std::int64_t{1};
    EXPECT_EQ(match(project, "fog-nave", foggy_methods(), still), nullptr);
}

TEST(Match, IsRefusedWithOneLine) {
    auto project = unmatched();
    EXPECT_THROW(match(project, "nobody", foggy_methods(), still), UsageError);
    EXPECT_THROW(match(project, "fog-nave", testing::registry(), still), UsageError) << "no reference";
    project.experiments[0].values["paths"] = std::string("direct");
    EXPECT_THROW(match(project, "fog-nave", foggy_methods(), still), UsageError)
        << "the truth cannot compute it";
    project.experiments[0].method = "teleport";
    EXPECT_THROW(match(project, "fog-nave", foggy_methods(), still), UsageError);
    project.experiments[0].method = "truth";
    EXPECT_THROW(match(project, "fog-nave", foggy_methods(), still), UsageError);
}

/// An experiment of the sample in which the document moves nothing: its frames differ if its scene does.
Experiment& standing(Project& project, int frames) {
    auto& plain = project.experiments[1];
    plain.reference.clear();
    plain.camera = "inside";
    plain.time = 2;
    plain.frames = frames;
    return plain;
}

/// The last frame is what is judged; a method that accumulates lets no time pass.
TEST(Match, WhereSomethingMovesTheTruthIsOfTheLastFrame) {
    auto project = unmatched();
    const auto id = standing(project, 7).id;
    EXPECT_DOUBLE_EQ(last_time(project.experiments[1], foggy_methods()), 2 + 6 / 30.0);
    UndoStack stack;
    ASSERT_TRUE(stack.push(project, match(project, id, foggy_methods(), animated)));
    const auto& found = *find_item(project.experiments, find_item(project.experiments, id)->reference);
    EXPECT_DOUBLE_EQ(found.time, 2 + 6 / 30.0);
    EXPECT_EQ(last_time(found, foggy_methods()), found.time);
    EXPECT_TRUE(mismatched_references(project, foggy_methods(), {animated}).empty());
    find_item(project.experiments, id)->frames = 1;
    const auto wrong = mismatched_references(project, foggy_methods(), {animated});
    ASSERT_EQ(wrong.size(), 1u);
    EXPECT_NE(wrong[0].second.find("time"), std::string::npos) << wrong[0].second;
    EXPECT_NE(match_id(project, id, animated), found.id) << "another moment, another truth";
}

TEST(Match, WhereNothingMovesAllNumbersOfFramesShareOneTruth) {
    auto project = unmatched();
    auto once = standing(project, 32);
    once.id = "once";
    once.frames = 1;
    once.time = 0;
    project.experiments.push_back(once);
    matched(project, "plain-nave");
    const auto truth = find_item(project.experiments, "plain-nave")->reference;
    EXPECT_EQ(find_item(project.experiments, truth)->time, 2) << "its own time";
    const auto count = project.experiments.size();
    EXPECT_EQ(match_id(project, "once", still), truth);
    matched(project, "once");
    EXPECT_EQ(project.experiments.size(), count);
    EXPECT_EQ(find_item(project.experiments, "once")->reference, truth);
    EXPECT_TRUE(mismatched_references(project, foggy_methods(), {still}).empty());
    EXPECT_EQ(mismatched_references(project, foggy_methods(), {animated}).size(), 2u);
}

TEST(Match, WhatTheDocumentMovesCountsWhateverTheFilesDo) {
    auto project = sample_project();
    EXPECT_TRUE(is_moving(project, project.experiments[0], still)) << "the spot swings, the church slides";
    EXPECT_FALSE(is_moving(project, standing(project, 1), still));
    EXPECT_TRUE(is_moving(project, project.experiments[1], animated));
}

/// "fog" has no key of sources, and says that it lacks light of surfaces.
TEST(Match, LeavesOutTheLightThatTheMethodLacks) {
    auto fog = testing::registry().at("fog");
    for (auto& parameter : fog.parameters)
        if (parameter.key == "paths") parameter.supported = {"ao", "full"};
    fog.missing_light = {{{LightPart::direct, LightPart::indirect}, {LightKind::surface, LightKind::lamp}},
                         {{LightPart::seen}, {LightKind::lamp}}};
    const Registry methods({&fog, &testing::registry().at("plain"), &truth()});
    auto project = unmatched();
    project.experiments[0].values["paths"] = std::string("full");
    match(project, "fog-nave", methods, still)->apply(project);
    auto& values = project.experiments[1].values;
    EXPECT_EQ(values.at("emitters"), Value{std::string("none")});
    EXPECT_EQ(values.at("environment_light"), Value{true}) << "its light is in the picture";
    SceneFacts facts{still};
    facts.light_sources = [](const Experiment&) {
        return std::vector<LightSource>{{LightKind::surface, "emissive material 'neon'"},
                                        {LightKind::punctual, "point light 'bulb'"}};
    };
    EXPECT_TRUE(mismatched_references(project, methods, facts).empty());
    values["emitters"] = std::string("all");
    const auto found = mismatched_references(project, methods, facts);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].second.find("light (emissive material 'neon' gives direct and indirect light in the "
                                   "reference alone)"),
              std::string::npos)
        << found[0].second;
    facts.light_sources = [](const Experiment&) {
        return std::vector<LightSource>{{LightKind::punctual, "point light 'bulb'"}};
    };
    EXPECT_TRUE(mismatched_references(project, methods, facts).empty()) << "nothing of the kind shines";
}

TEST(Match, MismatchesAreNamed) {
    auto project = unmatched();
    matched(project, "fog-nave");
    auto& reference = project.experiments[1];
    reference.values["max_distance"] = 3.0;
    reference.size = {8, 8};
    reference.camera = "inside";
    const auto found = mismatched_references(project, foggy_methods(), {still});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].first, "fog-nave");
    for (const char* part : {"camera", "size", "max_distance", "3"})
        EXPECT_NE(found[0].second.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace ir::projects
