#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/error.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/gltf_builder.h"
#include "tests/unit/scene/near.h"

// Nodes, animation, cameras and lights.

namespace {

using namespace ir;
using test::expect_near;
using test::GltfBuilder;
using test::Json;
using test::load;

/// A quarter turn about +Y: +Z goes to +X, -Z to -X.
Json quarter_turn() {
    return {0, 0.70710678, 0, 0.70710678};
}

TEST(GltfNodes, TransformsOfParentsApplyToChildren) {
    GltfBuilder builder;
    builder.json["nodes"] = {{{"mesh", 0}, {"translation", {1, 0, 0}}},
                             {{"children", {0}}, {"rotation", quarter_turn()}, {"scale", {2, 2, 2}}}};
    builder.json["scenes"] = {{{"nodes", {1}}}};
    builder.append(
        "meshes",
        {{"primitives", Json::array({{{"attributes", {{"POSITION", builder.triangle_positions()}}}}})}});
    const auto world = scene::flatten(load(builder), 0, 0);
    // (0,0,0) moves to (1,0,0), doubles and turns to (0,0,-2); (1,0,0) ends at (0,0,-4).
    expect_near(world.positions.at(0), {0, 0, -2});
    expect_near(world.positions.at(1), {0, 0, -4});
    expect_near(world.normals.at(0), {1, 0, 0});
}

TEST(GltfNodes, MatricesAreReadByColumns) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}}, -1, 4,
                 {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}});
    expect_near(scene::flatten(load(builder), 0, 0).positions.at(0), {5, 6, 7});
}

TEST(GltfNodes, OnlyTheDefaultSceneIsShown) {
    GltfBuilder builder;
    const int mesh = builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.append("nodes", {{"mesh", mesh}, {"translation", {0, 0, 9}}});
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    builder.json["scene"] = 1;
    const auto scene = load(builder);
    EXPECT_EQ(scene.instanced_triangles(), 1u);
    expect_near(scene::flatten(scene, 0, 0).positions.at(0), {0, 0, 9});
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].text.find("2 scenes"), std::string::npos);
}

TEST(GltfNodes, MirroredInstancesKeepNormalsOnTheFront) {
    GltfBuilder builder;
    const int positions = builder.triangle_positions();
    const float s = glm::one_over_root_two<float>();
    const int normals = builder.floats({s, 0, s, s, 0, s, s, 0, s}, "VEC3");
    const int tangents = builder.floats({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4");
    builder.draw({{"POSITION", positions}, {"NORMAL", normals}, {"TANGENT", tangents}}, -1, 4,
                 {{"scale", {-2, 1, 1}}});
    const auto world = scene::flatten(load(builder), 0, 0);
    const auto p = [&](int i) { return world.positions[world.indices[i]]; };
    const auto geometric = glm::cross(p(1) - p(0), p(2) - p(0));
    expect_near(glm::normalize(geometric), {0, 0, 1});
    // The inverse transpose of (-2, 1, 1) takes (1, 0, 1) to (-1/2, 0, 1).
    expect_near(world.normals[0], glm::normalize(glm::vec3(-0.5f, 0, 1)));
    // cross(n, t) * w must be the mirror image of what it was: (-s, 0, s) becomes (2s, 0, s) up to length.
    const auto bitangent = glm::cross(world.normals[0], glm::vec3(world.tangents[0])) * world.tangents[0].w;
    EXPECT_GT(bitangent.x, 0);
    EXPECT_EQ(world.tangents[0].w, -1);
}

TEST(GltfNodes, FlatInstancesHaveFiniteNormals) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}}, -1, 4, {{"scale", {1, 1, 0}}});
    expect_near(scene::flatten(load(builder), 0, 0).normals.at(0), {0, 0, 1});
}

/// A triangle whose node is animated by one channel with keys at 1 and 3 seconds.
scene::Scene animated(const std::string& path, const std::string& interpolation,
                      const std::vector<float>& values) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    const int input = builder.floats({1, 3}, "SCALAR");
    const int output = builder.floats(values, path == "rotation" ? "VEC4" : "VEC3");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}});
    return load(builder);
}

glm::vec3 origin_at(const scene::Scene& scene, double time) {
    return scene::world_matrices(scene, time).at(0)[3];
}

TEST(GltfAnimation, LinearTranslationClampsOutsideItsKeys) {
    const auto scene = animated("translation", "LINEAR", {0, 0, 0, 4, 0, 8});
    EXPECT_TRUE(scene.is_animated());
    EXPECT_EQ(scene.duration(), 3);
    expect_near(origin_at(scene, 0), {0, 0, 0});
    expect_near(origin_at(scene, 1.5), {1, 0, 2});
    expect_near(origin_at(scene, 9), {4, 0, 8});
}

TEST(GltfAnimation, StepsHoldTheirValue) {
    const auto scene = animated("translation", "STEP", {1, 0, 0, 4, 0, 8});
    expect_near(origin_at(scene, 2.999), {1, 0, 0});
    expect_near(origin_at(scene, 3), {4, 0, 8});
}

TEST(GltfAnimation, CubicSplinesUseTangentsTimesTheInterval) {
    // in, value, out per key: from 0 with slope 1 to 4 with slope 3, over 2 s.
    const auto scene =
        animated("translation", "CUBICSPLINE", {0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 4, 0, 0, 0, 0, 0});
    // Hermite at t = 1/2: 1/2 v0 + 1/8 (2 b0) + 1/2 v1 - 1/8 (2 a1) = 2 + 1/4 - 3/4
    expect_near(origin_at(scene, 2), {1.5f, 0, 0});
    expect_near(origin_at(scene, 3), {4, 0, 0});
}

TEST(GltfAnimation, RotationsTakeTheShortWayAtConstantSpeed) {
    const float s = glm::one_over_root_two<float>();
    // From none to a quarter turn about Y, the second quaternion negated.
    const auto scene = animated("rotation", "LINEAR", {0, 0, 0, 1, 0, -s, 0, -s});
    const float third = glm::half_pi<float>() / 4;
    const glm::vec3 x = scene::world_matrices(scene, 1.5).at(0)[0];
    expect_near(x, {std::cos(third), 0, -std::sin(third)});
}

TEST(GltfAnimation, MotionTakesPositionsBack) {
    const auto scene = animated("translation", "LINEAR", {0, 0, 0, 4, 0, 8});
    const auto world = scene::flatten(scene, 2, 1.5);
    ASSERT_EQ(world.to_previous.size(), world.positions.size());
    expect_near(world.positions[1] + world.to_previous[1], {2, 0, 2});
    EXPECT_TRUE(scene::flatten(scene, 2, 2).to_previous.empty());
}

TEST(GltfLights, PunctualLightsAreResolvedToWorldSpace) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"intensity", 7},
         {"color", {1, 0.5, 0}},
         {"range", 4},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
        {{"type", "directional"}, {"intensity", 3}},
        {{"type", "point"}}};
    for (int i = 0; i < 3; ++i)
        builder.add_node({{"translation", {1, 2, 3}},
                          {"rotation", quarter_turn()},
                          {"scale", {2, 2, 2}},
                          {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const auto lights = scene::flatten(load(builder), 0, 0).lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_EQ(lights[0].type, scene::LightType::spot);
    expect_near(lights[0].position, {1, 2, 3});
    expect_near(lights[0].direction, {-1, 0, 0});
    EXPECT_FLOAT_EQ(lights[0].intensity, 7);
    expect_near(lights[0].colour, {1, 0.5f, 0});
    EXPECT_FLOAT_EQ(lights[0].inner_angle, 0.2f);
    EXPECT_FLOAT_EQ(lights[0].outer_angle, 0.4f);
    EXPECT_FLOAT_EQ(lights[0].range, 4);
    EXPECT_EQ(lights[1].type, scene::LightType::directional);
    expect_near(lights[1].direction, {-1, 0, 0});
    EXPECT_EQ(lights[2].type, scene::LightType::point);
    EXPECT_FLOAT_EQ(lights[2].intensity, 1);
    EXPECT_EQ(lights[2].range, 0);
}

TEST(GltfCameras, LookAlongMinusZOfTheirNode) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}},
        {{"type", "orthographic"},
         {"name", "plan"},
         {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 10}}}}};
    builder.add_node({{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", quarter_turn()}});
    builder.add_node({{"camera", 1}});
    const auto scene = load(builder);
    const auto* eye = scene.find_camera("eye");
    ASSERT_NE(eye, nullptr);
    expect_near(eye->eye, {1, 2, 3});
    expect_near(glm::normalize(eye->target - eye->eye), {-1, 0, 0});
    expect_near(eye->up, {0, 1, 0});
    EXPECT_FLOAT_EQ(eye->fov_y, 0.8f);
    const auto* plan = scene.find_camera("plan");
    ASSERT_NE(plan, nullptr);
    EXPECT_TRUE(plan->orthographic);
    EXPECT_FLOAT_EQ(plan->height, 6);
    EXPECT_EQ(scene.find_camera("default"), nullptr);
}

TEST(GltfCameras, FilesWithoutOneGetACameraThatFramesThem) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}}, -1, 4, {{"translation", {100, 0, 0}}});
    const auto scene = load(builder);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "default");
    expect_near(scene.cameras[0].target, {100.5f, 0.5f, 0});
}

}  // namespace
