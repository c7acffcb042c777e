#include "app/engine/from_project.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir::engine {
namespace {

constexpr const char* method = "view-normals";

/// The Cornell box on a plane, half a metre below it and turned into a darker, glowing one.
projects::Project project_on_a_plane() {
    projects::Project project;
    projects::Scene scene{"both", "Both", {}};
    scene.parts.push_back({"builtin:cornell", "", {}});
    scene.parts.push_back({"builtin:plane?size=6", "", {}});
    scene.parts[1].transform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.5, 0, 1};
    scene.parts[1].materials["plane"].base_colour = {0.1, 0.2, 0.3, 1};
    scene.parts[1].materials["plane"].emission = {1, 2, 3};
    project.scenes.push_back(scene);
    projects::Experiment experiment;
    experiment.id = experiment.name = "first";
    experiment.scene = "both";
    experiment.method = method;
    experiment.method_version = registry().at(method).version;
    experiment.values = defaults(registry().at(method).parameters);
    experiment.size = {16, 12};
    project.experiments.push_back(experiment);
    return project;
}

Experiment resolved(const projects::Project& project, const std::filesystem::path& folder = ".") {
    return from_project(project, project.experiments.front(), folder);
}

const scene::Material& material(const scene::Scene& scene, const std::string& name) {
    for (const auto& each : scene.materials)
        if (each.name == name) return each;
    throw Error("no material " + name);
}

TEST(FromProject, ComposesAllPartsWithTransformsAndOverrides) {
    const auto experiment = resolved(project_on_a_plane());
    ASSERT_EQ(experiment.parts.size(), 2u);
    EXPECT_EQ(experiment.parts[0].transform, glm::mat4(1));
    EXPECT_EQ(experiment.parts[1].transform[3], glm::vec4(0, -0.5f, 0, 1));
    SceneCache cache;
    const auto both = cache.load(experiment.composition());
    const auto box = cache.load("builtin:cornell");
    EXPECT_EQ(both->instanced_triangles(), box->instanced_triangles() + 2);
    const auto bounds = scene::bounds_of(*both, 0), alone = scene::bounds_of(*box, 0);
    EXPECT_NEAR(bounds.min.x, -3, 1e-6);
    EXPECT_NEAR(bounds.max.x, 3, 1e-6);
    EXPECT_NEAR(bounds.min.y, -0.5, 1e-6);
    EXPECT_NEAR(bounds.max.y, alone.max.y, 1e-6);
    EXPECT_EQ(material(*both, "plane").base_colour, glm::vec4(0.1f, 0.2f, 0.3f, 1));
    EXPECT_EQ(material(*both, "plane").emission, glm::vec3(1, 2, 3));
    EXPECT_EQ(material(*both, "red").base_colour, material(*box, "red").base_colour);
}

TEST(FromProject, OnePlainPartIsTheSceneItself) {
    auto project = project_on_a_plane();
    project.scenes[0].parts.pop_back();
    const auto experiment = resolved(project);
    EXPECT_EQ(experiment.scene, "builtin:cornell");
    SceneCache cache;
    EXPECT_EQ(cache.load(experiment.composition()), cache.load("builtin:cornell"));
}

TEST(FromProject, SourcesStartAtTheProjectsFolder) {
    test::TemporaryFolder folder;
    const auto file = test::write_moving_triangle(folder);
    auto project = project_on_a_plane();
    project.scenes[0].parts[0].source = "moving.gltf";
    EXPECT_EQ(resolved(project, folder.path).parts[0].source, file);
}

TEST(FromProject, AnimatedPartsKeepMoving) {
    test::TemporaryFolder folder;
    test::write_moving_triangle(folder);
    auto project = project_on_a_plane();
    project.scenes[0].parts[0].source = "moving.gltf";
    project.scenes[0].parts[0].transform = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 7, 0, 1};
    SceneCache cache;
    const auto scene = cache.load(resolved(project, folder.path).composition());
    ASSERT_TRUE(scene->is_animated());
    const auto right_end = [&](double time) { return scene::bounds_of(*scene, time).max; };
    EXPECT_NEAR(right_end(1).x, 3, 1e-5) << "the plane's border; the triangle ends at 2";
    EXPECT_NEAR(right_end(2).x, 6, 1e-5);
    EXPECT_NEAR(right_end(3).x, 10, 1e-5);
    EXPECT_NEAR(right_end(3).y, 9, 1e-5);
}

TEST(FromProject, TakesOnlyValuesThatTheMethodKnows) {
    auto project = project_on_a_plane();
    project.experiments[0].values["from_the_future"] = 1.0;
    const auto experiment = resolved(project);
    EXPECT_EQ(experiment.settings.count("from_the_future"), 0u);
    EXPECT_EQ(experiment.settings.size(), registry().at(method).parameters.size());
}

TEST(FromProject, NamesTheSceneThatIsMissing) {
    auto project = project_on_a_plane();
    project.experiments[0].scene = "nowhere";
    EXPECT_THROW(resolved(project), Error);
}

TEST(SceneCache, KeepsFilesAndCompositionsApart) {
    SceneCache cache;
    const auto parts = resolved(project_on_a_plane()).parts;
    const auto first = cache.load(parts);
    EXPECT_EQ(cache.load(parts), first);
    auto other = parts;
    other[1].transform[3].y = -1;
    EXPECT_NE(cache.load(other), first);
    EXPECT_EQ(cache.load(parts), first) << "still in use";
    other = parts;
    other[1].materials["plane"].roughness = 0.5f;
    EXPECT_NE(cache.load(other)->content_hash, first->content_hash);
    cache.forget("builtin:plane?size=6");
    EXPECT_NE(cache.load(parts), first);
}

TEST(Execution, RunsACompositionAndNoticesWhenItChanges) {
    Machine machine;
    const auto wanted = resolved(project_on_a_plane());
    Execution execution(machine, wanted);
    execution.run_frame({});
    EXPECT_EQ(execution.world().triangles(), execution.scene().instanced_triangles());
    EXPECT_EQ(execution.world().bounds.min.y, -0.5f);
    EXPECT_EQ(attributes(execution).at("interreflect.scene"), "builtin:cornell + builtin:plane?size=6");
    EXPECT_EQ(attributes(execution).at("interreflect.scene_hash"), execution.scene().content_hash);

    execution.update(wanted);
    EXPECT_EQ(execution.committed_frames(), 1) << "nothing changed";
    auto lower = wanted;
    lower.parts[1].transform[3].y = -2;
    execution.update(lower);
    EXPECT_EQ(execution.committed_frames(), 0);
    execution.run_frame({});
    EXPECT_EQ(execution.world().bounds.min.y, -2.0f);
    auto darker = lower;
    darker.parts[1].materials["plane"].base_colour = glm::vec4(0, 0, 0, 1);
    execution.update(darker);
    EXPECT_EQ(execution.committed_frames(), 0);
    EXPECT_EQ(material(execution.scene(), "plane").base_colour, glm::vec4(0, 0, 0, 1));
}

}  // namespace
}  // namespace ir::engine
