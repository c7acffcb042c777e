#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "renderers/scene/world.h"
#include "tests/jpeg_of_scans.h"
#include "tests/unit/scene/gltf_builder.h"

// What is wrong with a file is said in one line that names the file and the place in it.

namespace {

using namespace ir;
using test::GltfBuilder;
using test::Json;
using test::TemporaryFolder;
using test::write_file;

std::string refusal_of(const std::string& file) {
    try {
        scene::load_scene(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "loaded";
}

void expect_refusal(const std::string& contents, const std::string& place, const std::string& problem) {
    const TemporaryFolder folder;
    const auto file = write_file(folder, "bad.gltf", contents);
    const auto refusal = refusal_of(file);
    EXPECT_EQ(refusal.rfind(file + ": " + place, 0), 0u) << refusal;
    EXPECT_NE(refusal.find(problem), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
}

GltfBuilder triangle() {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    return builder;
}

TEST(GltfErrors, MissingFile) {
    EXPECT_NE(refusal_of("no/such/file.gltf").find("no/such/file.gltf: no such file"), std::string::npos);
}

TEST(GltfErrors, NotJson) {
    expect_refusal("{\"asset\": ", "byte ", "not valid JSON");
}

TEST(GltfErrors, DeeplyNestedJson) {
    expect_refusal("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100000, '[') +
                       std::string(100000, ']') + "}",
                   "byte ", "nested deeper");
}

TEST(GltfErrors, OldVersion) {
    expect_refusal(R"({"asset":{"version":"1.0"}})", "asset.version", "only glTF 2");
}

TEST(GltfErrors, RequiredExtension) {
    auto builder = triangle();
    builder.json["extensionsRequired"] = {"KHR_texture_basisu"};
    expect_refusal(builder.embedded_text(), "extensionsRequired", "KHR_texture_basisu is not supported");
}

TEST(GltfErrors, MissingBuffer) {
    auto builder = triangle();
    builder.json["buffers"] = {{{"byteLength", 36}, {"uri", "absent.bin"}}};
    expect_refusal(builder.json.dump(), "buffers[0].uri", "absent.bin: no such file");
}

TEST(GltfErrors, NetworkUri) {
    auto builder = triangle();
    builder.json["buffers"] = {{{"byteLength", 36}, {"uri", "https://example.com/a.bin"}}};
    expect_refusal(builder.json.dump(), "buffers[0].uri", "scheme");
}

TEST(GltfErrors, FilesOutsideOfTheScenesFolder) {
    auto builder = triangle();
    for (const char* uri : {"/etc/passwd", "../a.bin", "%2e%2e/a.bin", "maps/../../a.bin"}) {
        builder.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        expect_refusal(builder.json.dump(), "buffers[0].uri", "leads out of the scene's folder");
    }
    for (const char* uri : {"~root/a.bin", "$HOME/a.bin"}) {
        builder.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
        expect_refusal(builder.json.dump(), "buffers[0].uri", "no such file");
    }
    builder = triangle();
    builder.append("images", {{"uri", "/etc/passwd"}});
    builder.append("textures", {{"source", 0}});
    builder.append("materials", {{"emissiveTexture", {{"index", 0}}}});
    expect_refusal(builder.embedded_text(), "images[0].uri", "leads out of the scene's folder");
    builder.json["images"][0]["uri"] = "../../stone.png";
    expect_refusal(builder.embedded_text(), "images[0].uri", "leads out of the scene's folder");
    builder.json["images"][0]["uri"] = "../textures/stone.png";
    expect_refusal(builder.embedded_text(), "images[0].uri", "no such file");
}

TEST(GltfErrors, DevicesAndPipes) {
    auto builder = triangle();
    builder.json["buffers"] = {{{"byteLength", 36}, {"uri", "a.bin"}}};
    const TemporaryFolder folder;
    const auto file = write_file(folder, "bad.gltf", builder.json.dump());
    ASSERT_EQ(mkfifo((folder.path / "a.bin").c_str(), 0600), 0);
    EXPECT_NE(refusal_of(file).find("a.bin: not a regular file"), std::string::npos) << refusal_of(file);
    EXPECT_NE(refusal_of("/dev/zero").find("not a regular file"), std::string::npos);
}

/// Each of twelve grey images of 16 Mi texels is a few kilobytes of zeros.
TEST(GltfErrors, TexturesThatExpandBeyondReasonAreRefused) {
    auto builder = triangle();
    const auto png = png_of(Image(4096, 4096, 1, 0.0f), 0);
    const auto uri = "data:image/png;base64," + GltfBuilder::base64({png.begin(), png.end()});
    for (int i = 0; i < 12; ++i) {
        builder.append("images", {{"uri", uri}});
        builder.append("textures", {{"source", i}});
        builder.append("materials", {{"emissiveTexture", {{"index", i}}}});
    }
    expect_refusal(builder.embedded_text(), "images[", "far more texels than the files have bytes");
}

TEST(GltfErrors, AccessorBeyondItsView) {
    auto builder = triangle();
    builder.json["accessors"][0]["count"] = 4;
    expect_refusal(builder.embedded_text(), "accessors[0].bufferView", "reaches to 48");
    builder.json["accessors"][0]["count"] = 2147483647;
    expect_refusal(builder.embedded_text(), "accessors[0].bufferView", "reaches to 25769803764");
}

TEST(GltfErrors, ViewBeyondItsBuffer) {
    auto builder = triangle();
    builder.json["bufferViews"][0]["byteOffset"] = 4;
    expect_refusal(builder.embedded_text(), "bufferViews[0].byteLength", "reaches to byte 40");
}

TEST(GltfErrors, ReferencesOutOfRange) {
    auto builder = triangle();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7;
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].attributes.POSITION", "accessors[7]");
    builder = triangle();
    builder.json["nodes"][0]["mesh"] = -1;
    expect_refusal(builder.embedded_text(), "nodes[0].mesh", "must lie in");
}

TEST(GltfErrors, IndexBeyondTheVertices) {
    GltfBuilder builder;
    const int indices =
        builder.accessor(builder.view(std::vector<std::uint8_t>{0, 1, 3}), test::type_ubyte, "SCALAR", 3);
    builder.draw({{"POSITION", builder.triangle_positions()}}, indices);
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].indices", "index 3 at 2");
}

TEST(GltfErrors, NotANumberInPositions) {
    GltfBuilder builder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    builder.draw({{"POSITION", builder.floats({0, 0, 0, 1, nan, 0, 0, 1, 0}, "VEC3")}});
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].attributes.POSITION",
                   "element 1 is not a finite");
}

TEST(GltfErrors, SparseIndexBeyondTheCount) {
    auto builder = triangle();
    const int indices = builder.view(std::vector<std::uint8_t>{3});
    builder.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", indices}, {"componentType", test::type_ubyte}}},
        {"values", {{"bufferView", builder.view(std::vector<float>{0, 0, 0})}}}};
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].attributes.POSITION", "sparse index");
}

TEST(GltfErrors, NodeThatIsItsOwnAncestor) {
    auto builder = triangle();
    builder.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
    expect_refusal(builder.embedded_text(), "nodes", "ancestors");
}

TEST(GltfErrors, FilesThatExpandBeyondReasonAreRefused) {
    GltfBuilder builder;
    const int nothing = builder.accessor(-1, test::type_float, "VEC3", 1000000000);
    builder.draw({{"POSITION", nothing}});
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0]", "far more geometry");
}

TEST(GltfErrors, MissingAndDamagedImagesMatterOnlyWhereUsed) {
    auto builder = triangle();
    builder.append("images", {{"uri", "absent.png"}});
    builder.append("images", {{"uri", "data:image/png;base64,AAAA"}});
    EXPECT_EQ(test::load(builder).textures.size(), 0u);
    builder.append("textures", {{"source", 0}});
    builder.append("materials", {{"emissiveTexture", {{"index", 0}}}});
    expect_refusal(builder.embedded_text(), "images[0].uri", "absent.png: no such file");
    builder.json["textures"][0]["source"] = 1;
    expect_refusal(builder.embedded_text(), "images[1]", "neither a PNG, a JPEG nor a WebP");
}

TEST(GltfErrors, GiantImageIsRefusedByItsHeader) {
    auto builder = triangle();
    std::vector<std::uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13,
                                  'I',  'H', 'D', 'R', 0,    1,    0,    0,    0, 1, 0, 0,
                                  8,    6,   0,   0,   0,    0,    0,    0,    0, 0, 0, 0};
    builder.append("images", {{"uri", "data:image/png;base64," + GltfBuilder::base64(png)}});
    builder.append("textures", {{"source", 0}});
    builder.append("materials", {{"normalTexture", {{"index", 0}}}});
    expect_refusal(builder.embedded_text(), "images[0]", "65536x65536");
}

TEST(GltfErrors, ScansWithoutEndAreRefused) {
    auto builder = triangle();
    const auto jpeg = test::jpeg_of_scans(101);
    builder.append("images",
                   {{"uri", "data:image/jpeg;base64," + GltfBuilder::base64({jpeg.begin(), jpeg.end()})}});
    builder.append("textures", {{"source", 0}});
    builder.append("materials", {{"normalTexture", {{"index", 0}}}});
    expect_refusal(builder.embedded_text(), "images[0]", "the image has 101 scans, more than 100");
}

TEST(GltfErrors, TruncatedGlb) {
    const auto whole = triangle().glb_bytes();
    const TemporaryFolder folder;
    EXPECT_EQ(refusal_of(write_file(folder, "whole.glb", whole)), "loaded");
    for (const std::size_t size : {std::size_t{5}, std::size_t{19}, whole.size() / 2, whole.size() - 1}) {
        const auto refusal = refusal_of(write_file(folder, "cut.glb", whole.substr(0, size)));
        EXPECT_NE(refusal.find("cut.glb: GLB header"), std::string::npos) << refusal;
    }
}

TEST(GltfErrors, NamesCannotBreakTheLine) {
    auto builder = triangle();
    builder.json["extensionsRequired"] = {"EVIL\nNAME\x1b[31m"};
    expect_refusal(builder.embedded_text(), "extensionsRequired", "EVIL?NAME?[31m");
}

/// A triangle of one joint, with one morph target.
GltfBuilder deforming() {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()},
                  {"JOINTS_0", builder.accessor(builder.view(std::vector<std::uint8_t>(12, 0)),
                                                test::type_ubyte, "VEC4", 3)},
                  {"WEIGHTS_0", builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4")}},
                 -1, 4, {{"skin", 0}});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
    builder.add_node(Json::object());
    const std::vector<float> matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const int matrices = builder.accessor(builder.view(matrix), test::type_float, "MAT4", 1);
    builder.append("skins", {{"joints", {1}}, {"inverseBindMatrices", matrices}});
    return builder;
}

TEST(GltfErrors, SkinsThatDisagree) {
    EXPECT_EQ(scene::flatten(test::load(deforming()), 0, 0).triangles(), 1u);
    auto builder = deforming();
    builder.bytes[builder.json["bufferViews"][1]["byteOffset"].get<std::size_t>() + 4] = 7;
    expect_refusal(builder.embedded_text(), "nodes[0].skin", "asks for 8 joints, but skins[0] has 1");
    builder = deforming();
    builder.json["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].attributes", "only one of JOINTS_0");
    builder = deforming();
    builder.json["skins"][0]["joints"] = {1, 1};
    expect_refusal(builder.embedded_text(), "skins[0].inverseBindMatrices", "1 matrices for 2 joints");
    builder.json["skins"][0]["joints"] = Json::array();
    expect_refusal(builder.embedded_text(), "skins[0].joints", "is empty");
    builder.json["skins"][0]["joints"] = {9};
    expect_refusal(builder.embedded_text(), "skins[0].joints", "refers to nodes[9]");
    builder = deforming();
    builder.json["scenes"][0]["nodes"] = {0};
    expect_refusal(builder.embedded_text(), "skins[0].joints", "nodes[1] is not in the scene");
    builder = deforming();
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(builder.bytes.data() + builder.json["bufferViews"][4]["byteOffset"].get<std::size_t>(),
                &not_a_number, sizeof not_a_number);
    expect_refusal(builder.embedded_text(), "skins[0].inverseBindMatrices", "not a finite number");
    builder = deforming();
    const float negative = -1;
    std::memcpy(builder.bytes.data() + builder.json["bufferViews"][2]["byteOffset"].get<std::size_t>(),
                &negative, sizeof negative);
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].attributes.WEIGHTS_0", "negative");
}

TEST(GltfErrors, MorphTargetsThatDisagree) {
    auto builder = deforming();
    builder.json["meshes"][0]["weights"] = {1, 2};
    expect_refusal(builder.embedded_text(), "meshes[0].weights", "are 2, but the mesh has 1 morph targets");
    builder = deforming();
    builder.json["nodes"][0]["weights"] = {1, 2};
    expect_refusal(builder.embedded_text(), "nodes[0].weights", "are 2, but the mesh has 1 morph targets");
    builder = deforming();
    builder.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[1].targets", "not as many");
    builder = deforming();
    builder.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] =
        builder.floats({0, 0, 1, 0, 0, 1}, "VEC3");
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0].targets[0].POSITION",
                   "has 2 elements, but POSITION has 3");
    builder = deforming();
    const int input = builder.floats({0, 1}, "SCALAR"), output = builder.floats({0, 1, 2}, "SCALAR");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", output}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    expect_refusal(builder.embedded_text(), "animations[0].samplers[0].output", "has 3 elements");
}

TEST(GltfErrors, ManyTargetsOfNothing) {
    auto builder = deforming();
    auto& accessors = builder.json["accessors"];
    // Zeros without a buffer, 2^20 corners, a thousand targets.
    for (auto& accessor : accessors)
        if (accessor["count"] == 3) accessor["count"] = 1 << 20, accessor.erase("bufferView");
    const Json target = builder.json["meshes"][0]["primitives"][0]["targets"][0];
    for (int i = 0; i < 1000; ++i) builder.json["meshes"][0]["primitives"][0]["targets"].push_back(target);
    expect_refusal(builder.embedded_text(), "meshes[0].primitives[0]", "far more geometry");
}

TEST(GltfErrors, VariantsOutOfRange) {
    auto builder = triangle();
    builder.json["materials"] = {{{"name", "oak"}}};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "light"}}};
    auto& mappings =
        builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"];
    const std::string place = "meshes[0].primitives[0].extensions.KHR_materials_variants.mappings[0]";
    mappings = {{{"material", 1}, {"variants", {0}}}};
    expect_refusal(builder.embedded_text(), place + ".material", "refers to materials[1]");
    mappings = {{{"material", 0}, {"variants", {1}}}};
    expect_refusal(builder.embedded_text(), place + ".variants", "refers to variants[1]");
}

}  // namespace
