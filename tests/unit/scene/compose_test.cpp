#include "renderers/scene/compose.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/error.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/gltf_builder.h"
#include "tests/unit/scene/near.h"

namespace ir::test {
namespace {

using scene::compose;
using scene::Part;

Part cornell() {
    return {"builtin:cornell"};
}
Part plane(const glm::mat4& transform = glm::mat4(1)) {
    return {"builtin:plane?size=2", transform};
}
glm::mat4 moved(float x, float y, float z) {
    return glm::translate(glm::mat4(1), glm::vec3(x, y, z));
}

const scene::Material& material(const scene::Scene& scene, const std::string& name) {
    for (const auto& each : scene.materials)
        if (each.name == name) return each;
    throw Error("no material " + name);
}

/// Vertices, triangles and their materials' names in the order of the nodes.
std::vector<std::string> drawn(const scene::Scene& scene) {
    std::vector<std::string> result;
    for (const auto& node : scene.nodes)
        for (const int mesh : node.meshes)
            result.push_back(scene.meshes.at(mesh).name + "/" +
                             scene.materials.at(scene.meshes.at(mesh).material).name);
    return result;
}

TEST(Compose, OnePlainPartIsTheSceneItself) {
    const auto alone = scene::load_scene("builtin:cornell");
    const auto composed = compose({cornell()});
    EXPECT_EQ(composed.name, alone.name);
    EXPECT_EQ(composed.content_hash, alone.content_hash);
    EXPECT_EQ(composed.nodes.size(), alone.nodes.size());
    EXPECT_EQ(composed.meshes.size(), alone.meshes.size());
    EXPECT_EQ(composed.cameras.size(), alone.cameras.size());
    EXPECT_EQ(scene::composition_key({cornell()}), "builtin:cornell");
    EXPECT_EQ(scene::flatten(composed, 0, 0).positions, scene::flatten(alone, 0, 0).positions);
}

TEST(Compose, AddsTrianglesMaterialsAndBounds) {
    const auto a = scene::load_scene("builtin:cornell"), b = scene::load_scene("builtin:plane?size=2");
    const auto both = compose({cornell(), plane(moved(10, 0, 0))});
    EXPECT_EQ(both.instanced_triangles(), a.instanced_triangles() + b.instanced_triangles());
    EXPECT_EQ(both.materials.size(), a.materials.size() + b.materials.size());
    EXPECT_EQ(both.material_count, a.material_count + b.material_count);
    auto names = drawn(a);
    for (const auto& name : drawn(b)) names.push_back(name);
    EXPECT_EQ(drawn(both), names) << "meshes keep their materials";
    const auto bounds = scene::bounds_of(both, 0), alone = scene::bounds_of(a, 0);
    expect_near(bounds.min, glm::min(alone.min, glm::vec3(9, 0, -1)));
    expect_near(bounds.max, glm::max(alone.max, glm::vec3(11, 0, 1)));
    EXPECT_EQ(scene::flatten(both, 0, 0).triangles(), both.instanced_triangles());
}

TEST(Compose, TransformsApplyAboveTheNodesOfAPart) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}}, -1, 4, {{"translation", {1, 0, 0}}});
    TemporaryFolder folder;
    const auto file = write_file(folder, "part.gltf", builder.embedded_text());
    const auto scaled = glm::scale(moved(0, 5, 0), glm::vec3(2));
    const auto bounds = scene::bounds_of(compose({{file, scaled}}), 0);
    expect_near(bounds.min, {2, 5, 0});
    expect_near(bounds.max, {4, 7, 0});
}

TEST(Compose, OneSourceMayStandInSeveralPlaces) {
    const auto three = compose({plane(), plane(moved(4, 0, 0)), plane(moved(8, 0, 0))});
    EXPECT_EQ(three.instanced_triangles(), 6u);
    EXPECT_EQ(three.textures.size(), scene::load_scene("builtin:plane").textures.size());
    EXPECT_NEAR(scene::bounds_of(three, 0).max.x, 9, 1e-5);
}

TEST(Compose, TextureSlotsFollowTheirTextures) {
    const auto alone = scene::load_scene("builtin:atrium");
    ASSERT_FALSE(alone.textures.empty());
    const auto check = [&](const scene::Scene& both, std::size_t first_material) {
        for (std::size_t i = 0; i < alone.materials.size(); ++i) {
            const int before = alone.materials[i].base_colour_texture.texture;
            const int now = both.materials.at(first_material + i).base_colour_texture.texture;
            ASSERT_EQ(before < 0, now < 0);
            if (before >= 0) {
                EXPECT_EQ(both.textures.at(now).name, alone.textures[before].name);
                EXPECT_EQ(both.textures.at(now).rgba, alone.textures[before].rgba);
            }
        }
    };
    const auto again = compose({{"builtin:atrium"}, {"builtin:atrium", moved(100, 0, 0)}});
    EXPECT_EQ(again.textures.size(), alone.textures.size()) << "kept once";
    check(again, 0);
    check(again, alone.materials.size());
}

TEST(Compose, OverridesReplaceWhatTheyGiveAndNothingElse) {
    Part part = cornell();
    part.materials["red"].base_colour = glm::vec4(0, 0, 1, 1);
    part.materials["red"].roughness = 0.25f;
    part.materials["lamp"].emission = glm::vec3(1, 2, 3);
    const auto before = scene::load_scene("builtin:cornell");
    const auto after = compose({part});
    EXPECT_EQ(material(after, "red").base_colour, glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(material(after, "red").roughness, 0.25f);
    EXPECT_EQ(material(after, "red").metallic, material(before, "red").metallic);
    EXPECT_EQ(material(after, "red").emission, material(before, "red").emission);
    EXPECT_EQ(material(after, "lamp").emission, glm::vec3(1, 2, 3));
    EXPECT_EQ(material(after, "lamp").base_colour, material(before, "lamp").base_colour);
    EXPECT_EQ(material(after, "green").base_colour, material(before, "green").base_colour);
    EXPECT_TRUE(after.warnings.empty());
}

TEST(Compose, OverridesStayWithinTheirPart) {
    Part changed = plane(moved(5, 0, 0));
    changed.materials["plane"].base_colour = glm::vec4(1, 0, 0, 1);
    const auto both = compose({plane(), changed});
    ASSERT_EQ(both.materials.size(), 2u);
    EXPECT_NE(both.materials[0].base_colour, both.materials[1].base_colour);
    EXPECT_EQ(both.materials[1].base_colour, glm::vec4(1, 0, 0, 1));
}

TEST(Compose, ATexturesMaterialKeepsItsTextureUnderAnOverride) {
    const auto alone = scene::load_scene("builtin:atrium");
    Part part{"builtin:atrium"};
    std::size_t textured = 0;
    while (alone.materials.at(textured).base_colour_texture.texture < 0) ++textured;
    part.materials[alone.materials[textured].name].base_colour = glm::vec4(0.5f, 0.5f, 0.5f, 1);
    const auto after = compose({part});
    EXPECT_EQ(after.materials[textured].base_colour, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    EXPECT_EQ(after.materials[textured].base_colour_texture.texture,
              alone.materials[textured].base_colour_texture.texture);
}

TEST(Compose, AnOverrideOfNoMaterialIsAWarningThatListsTheKnownOnes) {
    Part part = cornell();
    part.materials["rde"].metallic = 1.0f;
    const auto scene = compose({part});
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].severity, Severity::warning);
    EXPECT_EQ(
        scene.warnings[0].text,
        "part 'builtin:cornell' has no material 'rde' to override (did you mean 'red'?); known are white, red, "
        "green, lamp");
}

TEST(Compose, LightsAndCamerasMoveAndGetNamesOfTheirOwn) {
    const auto alone = scene::load_scene("builtin:cornell");
    const auto both = compose({cornell(), {"builtin:cornell", moved(3, 0, 0)}});
    ASSERT_EQ(both.lights.size(), 2u);
    EXPECT_EQ(both.lights[0].name, "lamp");
    EXPECT_EQ(both.lights[1].name, "lamp (2)");
    expect_near(both.lights[1].position, alone.lights[0].position + glm::vec3(3, 0, 0));
    expect_near(both.lights[1].direction, alone.lights[0].direction);
    EXPECT_EQ(both.lights[1].intensity, alone.lights[0].intensity);
    const auto* front = both.find_camera("front (2)");
    ASSERT_TRUE(front);
    expect_near(front->eye, alone.find_camera("front")->eye + glm::vec3(3, 0, 0));
    expect_near(front->target, alone.find_camera("front")->target + glm::vec3(3, 0, 0));
    expect_near(both.find_camera("front")->eye, alone.find_camera("front")->eye);
}

TEST(Compose, RotationsTurnLightsAndCameras) {
    const auto quarter = glm::rotate(glm::mat4(1), glm::half_pi<float>(), glm::vec3(0, 0, 1));
    const auto turned = compose({{"builtin:cornell", quarter}});
    expect_near(turned.lights.at(0).direction, {1, 0, 0});
    expect_near(turned.cameras.at(0).up, {-1, 0, 0});
}

TEST(Compose, AnimatedPartsKeepMovingUnderTheirTransform) {
    TemporaryFolder folder;
    const auto scene = compose({plane(), {write_moving_triangle(folder), moved(0, 10, 0)}});
    EXPECT_TRUE(scene.is_animated());
    EXPECT_EQ(scene.duration(), 3);
    const auto last_vertex = [&](double time) {
        for (std::size_t n = 0; n < scene.nodes.size(); ++n)
            if (!scene.nodes[n].meshes.empty() && scene.nodes[n].meshes[0] == 1)
                return glm::vec3(scene::world_matrices(scene, time).at(n)[3]);
        return glm::vec3(NAN);
    };
    expect_near(last_vertex(1), {0, 10, 0});
    expect_near(last_vertex(2), {2, 10, 0});
    expect_near(last_vertex(3), {4, 10, 0});
    const auto world = scene::flatten(scene, 2, 1);
    EXPECT_EQ(world.to_previous.size(), world.positions.size());
    EXPECT_NEAR(world.bounds.max.y, 11, 1e-5);
}

TEST(Compose, MadeUpCamerasGiveWayToRealOnes) {
    TemporaryFolder folder;
    const auto file = write_moving_triangle(folder);
    ASSERT_TRUE(scene::load_scene(file).find_camera("default"));
    EXPECT_FALSE(compose({plane(), {file}}).find_camera("default"));
    const auto without = compose({{file}, {file, moved(20, 0, 0)}});
    ASSERT_EQ(without.cameras.size(), 1u);
    EXPECT_EQ(without.cameras[0].name, "default");
    EXPECT_NEAR(without.cameras[0].target.x, 10.5, 1e-4) << "frames the whole";
}

TEST(Compose, TheEnvironmentIsThatOfTheFirstPartThatHasOne) {
    const scene::SceneLoader load = [](const std::string& name) {
        auto scene = std::make_shared<scene::Scene>(scene::load_scene("builtin:plane"));
        if (name != "dark") scene->environment.constant = name == "red" ? glm::vec3(1, 0, 0) : glm::vec3(2);
        return scene;
    };
    EXPECT_EQ(compose({{"dark"}, {"dark"}}, load).environment.constant, glm::vec3(0));
    EXPECT_EQ(compose({{"dark"}, {"red"}, {"white"}}, load).environment.constant, glm::vec3(1, 0, 0));
    EXPECT_EQ(compose({{"white"}, {"red"}}, load).environment.constant, glm::vec3(2));
}

TEST(Compose, ContentHashDependsOnPartsTransformsAndOverrides) {
    Part tinted = plane();
    tinted.materials["plane"].roughness = 0.5f;
    Part more = tinted;
    more.materials["plane"].roughness = 0.25f;
    Part other = plane();
    other.materials["plane"].metallic = 0.5f;
    std::vector<std::string> hashes;
    for (const auto& parts : {std::vector<Part>{plane()},
                              {plane(), plane()},
                              {plane(), cornell()},
                              {cornell(), plane()},
                              {plane(moved(1, 0, 0))},
                              {tinted},
                              {more},
                              {other}})
        hashes.push_back(compose(parts).content_hash);
    for (std::size_t i = 0; i < hashes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(hashes[i], hashes[j]) << i << " and " << j;
    EXPECT_EQ(compose({tinted}).content_hash, compose({tinted}).content_hash);
    EXPECT_EQ(hashes[1].size(), 32u);
}

TEST(Compose, ContentHashDoesNotDependOnTheFilesPlace) {
    TemporaryFolder here, there;
    const auto parts = [&](const TemporaryFolder& folder) {
        return std::vector<Part>{plane(), {write_moving_triangle(folder)}};
    };
    EXPECT_EQ(compose(parts(here)).content_hash, compose(parts(there)).content_hash);
}

TEST(Compose, AVariantMustBeThatOfAPartThatNamesIt) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["extensionsUsed"] = {"KHR_materials_variants"};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "light"}}};
    TemporaryFolder folder;
    Part chair{write_file(folder, "chair.gltf", builder.embedded_text())}, floor = plane();
    floor.variant = "light";
    EXPECT_THROW(compose({chair, floor}), UsageError) << "only a part that names none has it";
    chair.variant = "light";
    EXPECT_NO_THROW(compose({chair, floor})) << "the floor keeps its materials";
    chair.variant = "lihgt";
    EXPECT_THROW(compose({chair, floor}), UsageError);
}

TEST(Compose, RefusesWhatIsNoComposition) {
    EXPECT_THROW(compose({}), UsageError);
    EXPECT_THROW(compose({plane(), {"builtin:nothing"}}), UsageError);
    auto projective = glm::mat4(1);
    projective[0][3] = 1;
    EXPECT_THROW(compose({plane(projective)}), UsageError);
    EXPECT_THROW(compose({plane(moved(NAN, 0, 0))}), UsageError);
    for (const float value : {-0.1f, 1.1f, NAN}) {
        Part part = plane();
        part.materials["plane"].metallic = value;
        EXPECT_THROW(compose({part}), UsageError) << value;
    }
    Part dark = plane();
    dark.materials["plane"].emission = glm::vec3(0, -1, 0);
    EXPECT_THROW(compose({dark}), UsageError);
}

}  // namespace
}  // namespace ir::test
