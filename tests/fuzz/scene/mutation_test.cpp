#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <random>

#include "renderers/scene/gltf/scene_parts.h"
#include "tests/fuzz/scene/attempts.h"
#include "tests/unit/scene/gltf_builder.h"

// The corpus' twin that needs no files: small documents are broken in thousands of ways; each result loads
// and flattens or is refused in one line.

namespace {

using namespace ir;
using test::GltfBuilder;
using test::Json;
using Random = std::mt19937;

std::size_t below(Random& random, std::size_t count) {
    return count == 0 ? 0 : random() % count;
}

/// A little of everything that the loader reads.
GltfBuilder specimen() {
    GltfBuilder builder;
    builder.append(
        "images",
        {{"uri",
          "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQYV2P4z/AfAAQ"
          "AAf+I0P3MAAAAAElFTkSuQmCC"}});
    builder.append("samplers", {{"magFilter", 9728}, {"wrapS", 33071}});
    builder.append("textures", {{"source", 0}, {"sampler", 0}});
    builder.append("materials",
                   {{"alphaMode", "MASK"},
                    {"emissiveFactor", {1, 1, 1}},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {1, 1, 1, 1}},
                      {"baseColorTexture",
                       {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}}}},
                    {"extensions",
                     {{"KHR_materials_ior", {{"ior", 1.4}}},
                      {"KHR_materials_transmission",
                       {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}}}}});
    const int positions = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    const int changed = builder.view(std::vector<std::uint8_t>{3});
    builder.json["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", changed}, {"componentType", test::type_ubyte}}},
        {"values", {{"bufferView", builder.view(std::vector<float>{2, 2, 0})}}}};
    const int indices = builder.accessor(builder.view(std::vector<std::uint16_t>{0, 1, 2, 3}),
                                         test::type_ushort, "SCALAR", 4);
    const int uv = builder.accessor(
        builder.view(std::vector<std::uint8_t>{0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0, 1, 1}, 4),
        test::type_ubyte, "VEC2", 4, 0, true);
    builder.draw({{"POSITION", positions}, {"TEXCOORD_0", uv}}, indices, 5, {{"scale", {1, -1, 1}}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.draw({{"POSITION", positions}}, -1, 6, {{"rotation", {0, 0, 0, 1}}});
    builder.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}});
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", Json::object()}}};
    builder.append("nodes", {{"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.json["nodes"][0]["children"] = {2};
    auto& primitive = builder.json["meshes"][1]["primitives"][0];
    primitive["targets"] = {{{"POSITION", positions}}};
    primitive["attributes"]["JOINTS_0"] = builder.accessor(
        builder.view(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0}),
        test::type_ubyte, "VEC4", 4);
    primitive["attributes"]["WEIGHTS_0"] =
        builder.floats({1, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0}, "VEC4");
    builder.append("skins",
                   {{"joints", {0, 2}},
                    {"inverseBindMatrices", builder.accessor(builder.view(std::vector<float>(32, 0.5f)),
                                                             test::type_float, "MAT4", 2)}});
    builder.json["nodes"][1]["skin"] = 0;
    builder.json["nodes"][1]["weights"] = {0.25};
    builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "light"}}};
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}}};
    const int input = builder.floats({0, 1}, "SCALAR");
    const int output = builder.floats({0, 0, 0, 1, 1, 1}, "VEC3");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
    const int weights = builder.floats({0, 1}, "SCALAR");
    builder.append("animations",
                   {{"samplers", {{{"input", input}, {"output", weights}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "weights"}}}}}}});
    return builder;
}

/// All values of a tree, by pointer.
void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
        for (auto& child : value) collect(child, all);
}

Json strange_value(Random& random, const std::vector<Json*>& all) {
    switch (below(random, 14)) {
        case 0:
            return nullptr;
        case 1:
            return true;
        case 2:
            return -1;
        case 3:
            return 0;
        case 4:
            return static_cast<int>(below(random, 8));
        case 5:
            return 2147483647;
        case 6:
            return std::int64_t{1} << 62;
        case 7:
            return 1e300;
        case 8:
            return -0.5;
        case 9:
            return "";
        case 10:
            return "MAT4";
        case 11:
            return Json::array();
        case 12:
            return Json::object();
        default:
            return *all[below(random, all.size())];
    }
}

/// Replaces, removes or repeats values anywhere in the tree.
void mutate(Json& document, Random& random) {
    for (std::size_t i = 0; i <= below(random, 3); ++i) {
        std::vector<Json*> all;
        collect(document, all);
        auto& target = *all[1 + below(random, all.size() - 1)];
        const auto value = strange_value(random, all);
        if (target.is_object() && !target.empty() && below(random, 2) == 0)
            target.erase(
                std::next(target.begin(), static_cast<std::ptrdiff_t>(below(random, target.size()))));
        else if (target.is_array() && below(random, 2) == 0)
            target.push_back(value);
        else
            target = value;
    }
}

std::string flipped(std::string bytes, Random& random) {
    for (std::size_t i = 0; i <= below(random, 8); ++i) {
        const auto at = below(random, bytes.size());
        bytes[at] = static_cast<char>(below(random, 4) == 0 ? 0xff : random());
    }
    if (below(random, 8) == 0) bytes.resize(below(random, bytes.size()));
    return bytes;
}

class Mutations : public testing::Test {
  protected:
    /// Loads the bytes; counts what became of them.
    void attempt(const std::string& bytes, const std::string& what) {
        // A new name each time: some file systems write a truncated file through to the disk.
        const auto file = write_file(folder, std::to_string(loaded + refused) + ".gltf", bytes);
        try {
            ++(fuzz::loads_scene(file) ? loaded : refused);
        } catch (const std::exception& error) {
            ADD_FAILURE() << what << ": " << error.what();
        }
        std::filesystem::remove(file);
    }

    /// A run in which everything was refused, or nothing, would have tested little.
    void expect_both() const {
        EXPECT_GT(loaded, 20);
        EXPECT_GT(refused, 20);
    }

    test::TemporaryFolder folder;
    int loaded = 0, refused = 0;
};

TEST_F(Mutations, TheSpecimenItselfLoads) {
    attempt(specimen().embedded_text(), "embedded");
    attempt(specimen().glb_bytes(), "binary");
    EXPECT_EQ(loaded, 2);
}

TEST_F(Mutations, OfTheTree) {
    for (unsigned seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        auto document = Json::parse(specimen().embedded_text());
        mutate(document, random);
        attempt(document.dump(), "tree, seed " + std::to_string(seed));
    }
    expect_both();
}

TEST_F(Mutations, OfTheBytes) {
    const auto text = specimen().embedded_text(), binary = specimen().glb_bytes();
    for (unsigned seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        attempt(flipped(seed % 2 == 0 ? text : binary, random), "bytes, seed " + std::to_string(seed));
    }
    expect_both();
}

TEST_F(Mutations, OfTheBinaryData) {
    for (unsigned seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        auto builder = specimen();
        const std::string bytes(builder.bytes.begin(), builder.bytes.end());
        auto changed = flipped(bytes, random);
        changed.resize(bytes.size());
        builder.bytes.assign(changed.begin(), changed.end());
        attempt(builder.embedded_text(), "data, seed " + std::to_string(seed));
    }
    expect_both();
}

/// What libFuzzer begins with, and what it found before.
TEST(SceneSeeds, LoadOrAreRefusedInOneLine) {
    int loaded = 0;
    for (const auto& entry : std::filesystem::directory_iterator(SOURCE_ROOT "/tests/fuzz/corpus/gltf"))
        EXPECT_NO_THROW(loaded += fuzz::loads_scene(entry.path().string()) ? 1 : 0) << entry.path();
    EXPECT_GT(loaded, 1);
}

TEST(SceneSeeds, OnlyTheCameraIsMadeUp) {
    const std::string file = SOURCE_ROOT "/tests/fuzz/corpus/gltf/beyond-floats.gltf";
    const auto read = scene::gltf::load_without_camera(file), loaded = scene::load_gltf(file);
    EXPECT_TRUE(read.cameras.empty());
    ASSERT_EQ(loaded.cameras.size(), 1u);
    EXPECT_TRUE(loaded.cameras.front().is_made_up);
    EXPECT_EQ(read.content_hash, loaded.content_hash);
    EXPECT_EQ(read.warnings.size(), loaded.warnings.size());
    EXPECT_EQ(read.nodes.size(), loaded.nodes.size());
}

}  // namespace
