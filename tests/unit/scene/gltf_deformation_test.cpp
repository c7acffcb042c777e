#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/compose.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/gltf_builder.h"
#include "tests/unit/scene/near.h"

// Skins and morph targets, still and animated.

namespace {

using namespace ir;
using test::expect_near;
using test::GltfBuilder;
using test::Json;
using test::load;

void animate(GltfBuilder& builder, int node, const std::string& path, const std::vector<float>& times,
             const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    const int input = builder.floats(times, "SCALAR");
    const int output = builder.floats(values, path == "rotation" ? "VEC4" : "SCALAR");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}});
}

/// A bar of 2 m along +Y in the plane z = 0: pairs of vertices at x = ±0.1 and y = 0, 1, 2, with normals +X.
/// Joint 0 stands at its foot, joint 1 at y = 1; the pair between belongs to both. Nodes: bar, joint 0, joint
/// 1. In the second from 0 to 1 joint 1 turns by 90° about +Z. The bar's own node is elsewhere, which must
/// not matter.
GltfBuilder bar(bool eight_influences = false) {
    GltfBuilder builder;
    std::vector<float> positions, normals, weights;
    std::vector<std::uint8_t> joints;
    for (int i = 0; i < 6; ++i) {
        const float y = static_cast<float>(i / 2);
        positions.insert(positions.end(), {i % 2 == 0 ? -0.1f : 0.1f, y, 0});
        normals.insert(normals.end(), {1, 0, 0});
        joints.insert(joints.end(), {0, 1, 0, 0});
        weights.insert(weights.end(), {1 - y / 2, y / 2, 0, 0});
    }
    const std::vector<std::uint8_t> corners{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5};
    Json attributes{{"POSITION", builder.floats(positions, "VEC3")},
                    {"NORMAL", builder.floats(normals, "VEC3")}};
    const int joint_numbers = builder.accessor(builder.view(joints), test::type_ubyte, "VEC4", 6);
    const int parts = builder.floats(weights, "VEC4");
    attributes[eight_influences ? "JOINTS_1" : "JOINTS_0"] = joint_numbers;
    attributes[eight_influences ? "WEIGHTS_1" : "WEIGHTS_0"] = parts;
    if (eight_influences) {  // the first four say nothing
        attributes["JOINTS_0"] =
            builder.accessor(builder.view(std::vector<std::uint8_t>(24, 0)), test::type_ubyte, "VEC4", 6);
        attributes["WEIGHTS_0"] = builder.floats(std::vector<float>(24, 0), "VEC4");
    }
    builder.draw(attributes,
                 builder.accessor(builder.view(corners), test::type_ubyte, "SCALAR", corners.size()), 4,
                 {{"skin", 0}, {"translation", {5, 6, 7}}});
    builder.append("nodes", {{"children", {2}}, {"translation", {0, 0, 0}}});
    builder.append("nodes", {{"translation", {0, 1, 0}}});
    builder.json["scenes"][0]["nodes"].push_back(1);
    const std::vector<float> inverse_bind{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
    const int matrices = builder.accessor(builder.view(inverse_bind), test::type_float, "MAT4", 2);
    builder.append("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", matrices}});
    const float s = 0.70710678f;
    animate(builder, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, s, s});
    return builder;
}

void expect_bent(const scene::World& world) {
    ASSERT_EQ(world.positions.size(), 6u);
    expect_near(world.positions[0], {-0.1f, 0, 0});
    expect_near(world.positions[1], {0.1f, 0, 0});
    // Half-way between (±0.1, 1) and its turned (0, 1 ± 0.1).
    expect_near(world.positions[2], {-0.05f, 0.95f, 0});
    expect_near(world.positions[3], {0.05f, 1.05f, 0});
    expect_near(world.positions[4], {-1, 0.9f, 0});
    expect_near(world.positions[5], {-1, 1.1f, 0});
    expect_near(world.normals[1], {1, 0, 0});
    expect_near(world.normals[3], glm::normalize(glm::vec3(1, 1, 0)));
    expect_near(world.normals[5], {0, 1, 0});
}

TEST(GltfSkin, AnUnbentBarStandsWhereItsJointsAre) {
    const auto world = scene::flatten(load(bar()), 0, 0);
    expect_near(world.positions[4], {-0.1f, 2, 0});
    expect_near(world.positions[5], {0.1f, 2, 0});
    expect_near(world.bounds.max, {0.1f, 2, 0});
}

TEST(GltfSkin, ABarOfTwoJointsBends) {
    const auto scene = load(bar());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front().text;
    expect_bent(scene::flatten(scene, 1, 1));
    const auto bounds = scene::bounds_of(scene, 1);
    expect_near(bounds.min, {-1, 0, 0});
    expect_near(bounds.max, {0.1f, 1.1f, 0});
}

TEST(GltfSkin, TheSecondFourInfluencesCount) {
    expect_bent(scene::flatten(load(bar(true)), 1, 1));
}

TEST(GltfSkin, FurtherInfluencesAreIgnoredWithAWarning) {
    auto builder = bar();
    auto& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    for (const char* name : {"JOINTS_", "WEIGHTS_"}) {
        const Json first = attributes[name + std::string("0")];
        for (const char* set : {"2", "3"}) attributes[name + std::string(set)] = first;
    }
    const auto scene = load(builder);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].text, "joints beyond the eighth of a vertex are ignored");
    expect_bent(scene::flatten(scene, 1, 1));
}

TEST(GltfSkin, WeightsNeedNotAddUpToOne) {
    auto builder = bar();
    auto* weights = reinterpret_cast<float*>(builder.bytes.data() +
                                             builder.json["bufferViews"][3]["byteOffset"].get<std::size_t>());
    for (int i = 0; i < 24; ++i) weights[i] *= 3;
    expect_bent(scene::flatten(load(builder), 1, 1));
}

TEST(GltfSkin, VelocityIsTheDifferenceOfPositions) {
    const auto scene = load(bar());
    const auto now = scene::flatten(scene, 0.6, 0.5), before = scene::flatten(scene, 0.5, 0.5);
    ASSERT_EQ(now.to_previous.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i)
        expect_near(now.positions[i] + now.to_previous[i], before.positions[i], 1e-6f);
    EXPECT_GT(glm::length(now.to_previous[5]), 0.1f);
    EXPECT_EQ(glm::length(now.to_previous[0]), 0);
    EXPECT_TRUE(before.to_previous.empty());
}

TEST(GltfSkin, PartsTakeTheirSkinsAlong) {
    const test::TemporaryFolder folder;
    const auto file = test::write_file(folder, "bar.gltf", bar().embedded_text());
    const auto up = glm::translate(glm::mat4(1), glm::vec3(0, 10, 0));
    const auto scene = scene::compose({{"builtin:plane?size=2"}, {file}, {file, up}});
    EXPECT_EQ(scene.skins.size(), 2u);
    const auto world = scene::flatten(scene, 1, 1);
    expect_near(world.bounds.max, {1, 11.1f, 1});
}

/// A joint that mirrors all below it.
TEST(GltfSkin, MirroredJointsKeepNormalsOnTheFront) {
    auto builder = bar();
    builder.json["nodes"][1]["scale"] = {-1, 1, 1};
    const auto world = scene::flatten(load(builder), 0, 0);
    const auto p = [&](int i) { return world.positions[world.indices[i]]; };
    const auto face = glm::cross(p(1) - p(0), p(2) - p(0));
    EXPECT_GT(face.z, 0);  // as before it was mirrored
    expect_near(world.normals[0], {-1, 0, 0});
}

/// A triangle with two targets: the first moves its last corner by (0, 0, 2), the second all by (4, 0, 0).
GltfBuilder morphing(const Json& node = Json::object()) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}}, -1, 4, node);
    builder.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", builder.floats({0, 0, 0, 0, 0, 0, 0, 0, 2}, "VEC3")}},
        {{"POSITION", builder.floats({4, 0, 0, 4, 0, 0, 4, 0, 0}, "VEC3")}}};
    return builder;
}

TEST(GltfMorph, WithoutWeightsMeshesKeepTheirShape) {
    const auto scene = load(morphing());
    EXPECT_TRUE(scene.warnings.empty());
    expect_near(scene::flatten(scene, 0, 0).positions[2], {0, 1, 0});
}

TEST(GltfMorph, AWeightOfOneHalfIsHalfWay) {
    auto builder = morphing({{"translation", {0, 0, 1}}});
    builder.json["meshes"][0]["weights"] = {0.5, 0};
    const auto world = scene::flatten(load(builder), 0, 0);
    expect_near(world.positions[0], {0, 0, 1});
    expect_near(world.positions[2], {0, 1, 2});
    // The file has no normals, so they are the triangle's.
    for (const auto& normal : world.normals) expect_near(normal, glm::normalize(glm::vec3(0, -1, 1)));
    expect_near(world.bounds.max, {1, 1, 2});
}

TEST(GltfMorph, NormalsAndTangentsHaveDeltas) {
    GltfBuilder builder;
    const int positions = builder.triangle_positions();
    const int normals = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int tangents = builder.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    builder.draw({{"POSITION", positions}, {"NORMAL", normals}, {"TANGENT", tangents}});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"NORMAL", builder.floats({0, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC3")},
         {"TANGENT", builder.floats({-1, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
    builder.json["nodes"][0]["weights"] = {0.5};
    const auto world = scene::flatten(load(builder), 0, 0);
    expect_near(world.positions[0], {0, 0, 0});
    expect_near(world.normals[0], glm::normalize(glm::vec3(0, 1, 1)));
    expect_near(world.normals[1], {0, 0, 1});
    expect_near(glm::vec3(world.tangents[0]), glm::normalize(glm::vec3(1, 1, 0)));
}

TEST(GltfMorph, EachNodeOfAMeshHasItsOwnShape) {
    auto builder = morphing({{"weights", {1, 0}}});
    builder.json["meshes"][0]["weights"] = {0, 1};
    builder.add_node({{"mesh", 0}});
    const auto world = scene::flatten(load(builder), 0, 0);
    ASSERT_EQ(world.positions.size(), 6u);
    expect_near(world.positions[2], {0, 1, 2});
    expect_near(world.positions[5], {4, 1, 0});
}

TEST(GltfMorph, WeightsAreAnimatedSideBySide) {
    auto builder = morphing();
    animate(builder, 0, "weights", {0, 2}, {0, 1, 1, 0});
    const auto scene = load(builder);
    EXPECT_EQ(scene.duration(), 2);
    const auto world = scene::flatten(scene, 0.5, 0);
    expect_near(world.positions[2], {3, 1, 0.5f});
    expect_near(world.to_previous[2], {1, 0, -0.5f});
    expect_near(world.to_previous[0], {1, 0, 0});
}

TEST(GltfMorph, CubicWeightsHaveTheirTangentsByKey) {
    auto builder = morphing();
    // Of each key: in-tangents, values, out-tangents of both targets.
    animate(builder, 0, "weights", {0, 1}, {0, 0, 0, 1, 2, 0, 0, 0, 1, 1, 0, 0}, "CUBICSPLINE");
    const auto world = scene::flatten(load(builder), 0.5, 0.5);
    // 1/2 · 0 + 1/8 · 2 + 1/2 · 1 = 3/4 of the first target.
    expect_near(world.positions[2], {4, 1, 1.5f});
}

TEST(GltfMorph, ComesBeforeTheSkin) {
    auto builder = bar();
    std::vector<float> deltas(18, 0);
    deltas[16] = 1;  // the last vertex, 1 m up
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", builder.floats(deltas, "VEC3")}}};
    builder.json["meshes"][0]["weights"] = {1};
    expect_near(scene::flatten(load(builder), 1, 1).positions[5], {-2, 1.1f, 0});
}

TEST(GltfVariants, ChooseMaterialsOfAPart) {
    GltfBuilder builder;
    builder.json["materials"] = {{{"name", "oak"}}, {{"name", "pine"}}, {{"name", "steel"}}};
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["extensionsUsed"] = {"KHR_materials_variants"};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "light"}},
                                                                        {{"name", "cold"}}};
    for (int i = 0; i < 2; ++i) builder.json["meshes"][i]["primitives"][0]["material"] = 0;
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}, {{"material", 2}, {"variants", {1}}}};
    const test::TemporaryFolder folder;
    const auto file = test::write_file(folder, "chair.gltf", builder.embedded_text());
    const auto materials = [&](const std::string& variant) {
        scene::Part part{file};
        part.variant = variant;
        const auto scene = scene::compose({part});
        EXPECT_EQ(scene.variants, (std::vector<std::string>{"light", "cold"}));
        std::vector<std::string> names;
        for (const auto& mesh : scene.meshes) names.push_back(scene.materials.at(mesh.material).name);
        return names;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(materials(""), (Names{"oak", "oak"}));
    EXPECT_EQ(materials("light"), (Names{"pine", "oak"}));
    EXPECT_EQ(materials("cold"), (Names{"steel", "oak"}));
    scene::Part light{file}, cold{file};
    light.variant = "light", cold.variant = "cold";
    EXPECT_NE(scene::compose({light}).content_hash, scene::compose({cold}).content_hash);
}

}  // namespace
