#include <gtest/gtest.h>

#include "renderers/core/error.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/gltf_builder.h"

namespace {

using namespace ir;
using test::GltfBuilder;
using test::load;

/// Corner positions of a mesh's triangles, in order.
std::vector<glm::vec3> corners(const scene::Mesh& mesh) {
    std::vector<glm::vec3> result;
    for (const auto index : mesh.indices) result.push_back(mesh.positions[index]);
    return result;
}

std::vector<float> square() {
    return {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
}

std::vector<glm::vec3> points(const std::vector<float>& coordinates, const std::vector<int>& order) {
    std::vector<glm::vec3> result;
    for (const int i : order)
        result.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    return result;
}

TEST(GltfGeometry, ReadsTrianglesWithoutIndices) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    const auto scene = load(builder);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(corners(scene.meshes[0]), points(square(), {0, 1, 2}));
}

TEST(GltfGeometry, StripsKeepTheWindingOfTheirFirstTriangle) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.floats(square(), "VEC3")}}, -1, 5);
    const auto mesh = load(builder).meshes.at(0);
    ASSERT_EQ(mesh.indices.size(), 6u);
    for (const auto& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(corners(mesh), points(square(), {0, 1, 2, 1, 3, 2}));
}

TEST(GltfGeometry, FansShareTheirFirstCorner) {
    GltfBuilder builder;
    const std::vector<float> pentagon{0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0, 0, 1, 0};
    builder.draw({{"POSITION", builder.floats(pentagon, "VEC3")}}, -1, 6);
    const auto mesh = load(builder).meshes.at(0);
    EXPECT_EQ(corners(mesh), points(pentagon, {1, 2, 0, 2, 3, 0, 3, 4, 0}));
    for (const auto& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

template <class T>
scene::Mesh indexed_square(int type) {
    GltfBuilder builder;
    const int positions = builder.floats(square(), "VEC3");
    const int normals = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int indices = builder.accessor(builder.view(std::vector<T>{2, 0, 1, 3, 2, 1}), type, "SCALAR", 6);
    builder.draw({{"POSITION", positions}, {"NORMAL", normals}}, indices);
    return load(builder).meshes.at(0);
}

TEST(GltfGeometry, ReadsAllIndexTypes) {
    const auto expected = points(square(), {2, 0, 1, 3, 2, 1});
    EXPECT_EQ(corners(indexed_square<std::uint8_t>(test::type_ubyte)), expected);
    EXPECT_EQ(corners(indexed_square<std::uint16_t>(test::type_ushort)), expected);
    EXPECT_EQ(corners(indexed_square<std::uint32_t>(test::type_uint)), expected);
}

TEST(GltfGeometry, ReadsOnlyVerticesThatAreDrawn) {
    GltfBuilder builder;
    auto many = square();
    many.resize(3 * 1000, 7.0f);
    const int indices =
        builder.accessor(builder.view(std::vector<std::uint16_t>{0, 999, 2}), test::type_ushort, "SCALAR", 3);
    builder.draw({{"POSITION", builder.floats(many, "VEC3")}}, indices);
    const auto mesh = load(builder).meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(corners(mesh)[1], glm::vec3(7));
}

TEST(GltfGeometry, ReadsInterleavedAttributes) {
    GltfBuilder builder;
    const int view = builder.view(std::vector<float>{0, 0, 0, 0, 0, 1, .25f, .5f,  //
                                                     1, 0, 0, 0, 0, 1, .75f, .5f,  //
                                                     0, 1, 0, 0, 0, 1, .25f, 1.0f},
                                  32);
    builder.draw({{"POSITION", builder.accessor(view, test::type_float, "VEC3", 3)},
                  {"NORMAL", builder.accessor(view, test::type_float, "VEC3", 3, 12)},
                  {"TEXCOORD_0", builder.accessor(view, test::type_float, "VEC2", 3, 24)}});
    const auto mesh = load(builder).meshes.at(0);
    EXPECT_EQ(corners(mesh), points(square(), {0, 1, 2}));
    EXPECT_EQ(mesh.uv0, (std::vector<glm::vec2>{{.25f, .5f}, {.75f, .5f}, {.25f, 1}}));
}

TEST(GltfGeometry, SparseAccessorsReplaceElements) {
    GltfBuilder builder;
    const int positions = builder.triangle_positions();
    const int indices = builder.view(std::vector<std::uint8_t>{1});
    const int values = builder.view(std::vector<float>{5, 6, 7});
    builder.json["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", test::type_ubyte}}},
        {"values", {{"bufferView", values}}}};
    builder.draw({{"POSITION", positions}});
    const auto all = corners(load(builder).meshes.at(0));
    EXPECT_EQ(all, (std::vector<glm::vec3>{{0, 0, 0}, {5, 6, 7}, {0, 1, 0}}));
}

TEST(GltfGeometry, SparseAccessorsWithoutBufferStartFromZeros) {
    GltfBuilder builder;
    const int positions = builder.accessor(-1, test::type_float, "VEC3", 3);
    const int indices = builder.view(std::vector<std::uint16_t>{1, 2});
    const int values = builder.view(std::vector<float>{1, 0, 0, 0, 2, 0});
    builder.json["accessors"][positions]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", test::type_ushort}}},
        {"values", {{"bufferView", values}}}};
    builder.draw({{"POSITION", positions}});
    const auto all = corners(load(builder).meshes.at(0));
    EXPECT_EQ(all, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}));
}

TEST(GltfGeometry, ReadsQuantisedAttributes) {
    GltfBuilder builder;
    builder.json["extensionsRequired"] = builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    const int shorts =
        builder.view(std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}, 8);
    const int positions = builder.accessor(shorts, test::type_short, "VEC3", 3, 0, true);
    const int plain = builder.view(std::vector<std::int8_t>{0, 0, 0, 0, 3, 0, 0, 0, 0, -4, 0, 0}, 4);
    const int integers = builder.accessor(plain, test::type_byte, "VEC3", 3);
    const int coordinates =
        builder.accessor(builder.view(std::vector<std::uint16_t>{0, 65535, 65535, 0, 32768, 0}),
                         test::type_ushort, "VEC2", 3, 0, true);
    builder.draw({{"POSITION", positions}, {"TEXCOORD_0", coordinates}});
    builder.draw({{"POSITION", integers}});
    const auto scene = load(builder);
    EXPECT_EQ(corners(scene.meshes.at(0)), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
    EXPECT_NEAR(scene.meshes[0].uv0[2].x, 0.5f, 1e-4f);
    EXPECT_EQ(corners(scene.meshes.at(1)), (std::vector<glm::vec3>{{0, 0, 0}, {3, 0, 0}, {0, -4, 0}}));
}

TEST(GltfGeometry, ReadsVertexColours) {
    GltfBuilder builder;
    const int three = builder.floats({1, 0, 0, 0, .5f, 0, 0, 0, .25f}, "VEC3");
    const int four =
        builder.accessor(builder.view(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 0, 0, 0, 0, 0, 0, 51}),
                         test::type_ubyte, "VEC4", 3, 0, true);
    builder.draw({{"POSITION", builder.triangle_positions()}, {"COLOR_0", three}});
    builder.draw({{"POSITION", builder.triangle_positions()}, {"COLOR_0", four}});
    const auto scene = load(builder);
    EXPECT_EQ(scene.meshes.at(0).colours[1], glm::vec4(0, .5f, 0, 1));
    EXPECT_NEAR(scene.meshes.at(1).colours[0].z, 0.2f, 1e-6f);
    const auto world = scene::flatten(scene, 0, 0);
    EXPECT_EQ(world.colours[0], 0xff0000ffu);
    EXPECT_EQ(world.colours[3], 0xff3300ffu);
}

TEST(GltfGeometry, MissingNormalsAreFlatAndMissingTangentsFollowTheTexture) {
    GltfBuilder builder;
    // A roof: two triangles that share an edge, tilted against each other.
    const int positions = builder.floats({0, 0, 0, 0, 1, 0, -1, 0, -1, 1, 0, -1}, "VEC3");
    const int indices = builder.accessor(builder.view(std::vector<std::uint8_t>{0, 1, 2, 0, 3, 1}),
                                         test::type_ubyte, "SCALAR", 6);
    builder.draw({{"POSITION", positions}}, indices);
    const auto mesh = load(builder).meshes.at(0);
    ASSERT_EQ(mesh.normals.size(), 6u);
    for (int t = 0; t < 2; ++t) {
        const auto all = corners(mesh);
        const auto face =
            glm::normalize(glm::cross(all[3 * t + 1] - all[3 * t], all[3 * t + 2] - all[3 * t]));
        for (int i = 0; i < 3; ++i) EXPECT_GT(glm::dot(mesh.normals[3 * t + i], face), 0.9999f);
    }
}

TEST(GltfGeometry, GeneratedTangentsPointAlongUAndAgreeWithTheImagesUp) {
    GltfBuilder builder;
    const int normals = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    // v grows downwards in glTF: an upright image has v = 1 at the bottom.
    const int upright = builder.floats({0, 1, 1, 1, 0, 0}, "VEC2");
    const int mirrored = builder.floats({1, 1, 0, 1, 1, 0}, "VEC2");
    const int position = builder.triangle_positions();
    builder.draw({{"POSITION", position}, {"NORMAL", normals}, {"TEXCOORD_0", upright}});
    builder.draw({{"POSITION", position}, {"NORMAL", normals}, {"TEXCOORD_0", mirrored}});
    builder.draw({{"POSITION", position}, {"NORMAL", normals}});
    const auto scene = load(builder);
    for (const auto& t : scene.meshes.at(0).tangents) EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));
    for (const auto& t : scene.meshes.at(1).tangents) EXPECT_EQ(t, glm::vec4(-1, 0, 0, -1));
    for (const auto& t : scene.meshes.at(2).tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(t)), 1, 1e-6f);
        EXPECT_NEAR(t.z, 0, 1e-6f);
    }
}

TEST(GltfGeometry, GeneratedTangentsFollowTheNormalMapsCoordinates) {
    GltfBuilder builder;
    builder.append("images", {{"uri",
                               "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQ"
                               "YV2P4z/AfAAQAAf+I0P3MAAAAAElFTkSuQmCC"}});
    builder.append("textures", {{"source", 0}});
    builder.append("materials", {{"normalTexture", {{"index", 0}, {"texCoord", 1}}}});
    const int normals = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int along_x = builder.floats({0, 1, 1, 1, 0, 0}, "VEC2");
    const int along_y = builder.floats({0, 0, 0, 1, 1, 0}, "VEC2");
    builder.draw({{"POSITION", builder.triangle_positions()},
                  {"NORMAL", normals},
                  {"TEXCOORD_0", along_x},
                  {"TEXCOORD_1", along_y}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    const auto mesh = load(builder).meshes.at(0);
    EXPECT_EQ(glm::vec3(mesh.tangents.at(0)), glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.uv0.at(1), glm::vec2(1, 1));
}

TEST(GltfGeometry, PointsAndLinesAreSkippedWithAWarning) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.floats(square(), "VEC3")}}, -1, 1);
    builder.draw({{"POSITION", builder.triangle_positions()}});
    const auto scene = load(builder);
    EXPECT_EQ(scene.primitive_triangles(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].text.find("points and lines"), std::string::npos);
}

TEST(GltfGeometry, CountsPrimitivesOnceAndInstancesAsDrawn) {
    GltfBuilder builder;
    const int mesh = builder.draw({{"POSITION", builder.floats(square(), "VEC3")}}, -1, 5);
    builder.add_node({{"mesh", mesh}, {"translation", {2, 0, 0}}});
    const auto scene = load(builder);
    EXPECT_EQ(scene.primitive_triangles(), 2u);
    EXPECT_EQ(scene.instanced_triangles(), 4u);
    const auto world = scene::flatten(scene, 0, 0);
    EXPECT_EQ(world.triangles(), 4u);
    EXPECT_EQ(world.bounds.max, glm::vec3(3, 1, 0));
}

}  // namespace
