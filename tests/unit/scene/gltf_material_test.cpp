#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "renderers/core/error.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/gltf_builder.h"

namespace {

using namespace ir;
using test::GltfBuilder;
using test::Json;
using test::load;

/// A PNG of 2 by 1 texels: opaque red, and green with alpha 51.
const char* two_texels =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR4nGP4z8DwHwiNARAsAzEHKKJjAAAAAElFTkSuQmCC";

/// The same in WebP, lossless, and one colour of 5 by 4 texels, lossy.
const char* two_texels_webp =
    "data:image/webp;base64,UklGRiAAAABXRUJQVlA4TBMAAAAvAQAAEA8w//sfp/kPBxWI6H8AAA==";
const char* orange_webp =
    "data:image/webp;base64,"
    "UklGRj4AAABXRUJQVlA4IDIAAADQAQCdASoFAAQAAMASJaACdLoB+AADsAD+2ib/7vN+09e09f1M//jKnyA/4yp/xcwAAA==";

/// A drawn triangle with one material.
GltfBuilder with_material(const Json& material) {
    GltfBuilder builder;
    builder.append("materials", material);
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.append("images", {{"uri", two_texels}});
    builder.append("textures", {{"source", 0}});
    return builder;
}

TEST(GltfMaterials, ReadsFactorsAndExtensions) {
    const auto scene = load(with_material(
        {{"name", "glass"},
         {"doubleSided", true},
         {"emissiveFactor", {0.5, 0.25, 0}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
           {"KHR_materials_ior", {{"ior", 1.33}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 2}, {"attenuationDistance", 3}, {"attenuationColor", {1, 0.5, 0.25}}}},
           {"KHR_materials_unlit", Json::object()}}}}));
    const auto& m = scene.materials.at(0);
    EXPECT_EQ(m.name, "glass");
    EXPECT_TRUE(m.double_sided);
    EXPECT_TRUE(m.unlit);
    EXPECT_EQ(m.emission, glm::vec3(4, 2, 0));
    EXPECT_EQ(m.base_colour, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.ior, 1.33f);
    EXPECT_EQ(m.transmission, 0.75f);
    EXPECT_EQ(m.thickness, 2);
    EXPECT_EQ(m.attenuation_distance, 3);
    EXPECT_EQ(m.attenuation_colour, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(scene.material_count, 1u);
}

TEST(GltfMaterials, PrimitivesWithoutOneGetADefaultThatIsNotCounted) {
    GltfBuilder builder;
    builder.append("materials", {{"name", "unused"}});
    builder.draw({{"POSITION", builder.triangle_positions()}});
    const auto scene = load(builder);
    EXPECT_EQ(scene.material_count, 1u);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.meshes.at(0).material, 1);
    EXPECT_EQ(scene.materials[1].base_colour, glm::vec4(1));
}

TEST(GltfMaterials, UnnamedOnesGetNamesOfTheirOwn) {
    GltfBuilder builder;
    for (const char* name : {"", "material 2", "", "wood", "wood"})
        builder.append("materials", *name ? Json{{"name", name}} : Json::object());
    builder.draw({{"POSITION", builder.triangle_positions()}});
    std::vector<std::string> names;
    for (const auto& material : load(builder).materials) names.push_back(material.name);
    EXPECT_EQ(names, (std::vector<std::string>{"material 1", "material 2", "material 3", "wood", "wood",
                                               "default"}));
}

TEST(GltfMaterials, ReadsTexturesWithTransformsAndSamplers) {
    auto builder = with_material(
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"offset", {0.5, 0}}, {"scale", {2, 4}}, {"rotation", 0.5}, {"texCoord", 1}}}}}}},
           {"metallicRoughnessTexture", {{"index", 0}}}}},
         {"normalTexture", {{"index", 0}, {"scale", 0.5}}}});
    builder.append("samplers",
                   {{"magFilter", 9728}, {"minFilter", 9984}, {"wrapS", 33071}, {"wrapT", 33648}});
    builder.json["textures"][0]["sampler"] = 0;
    const auto scene = load(builder);
    const auto& m = scene.materials.at(0);
    const auto& slot = m.base_colour_texture;
    EXPECT_EQ(slot.uv_set, 1);
    EXPECT_EQ(slot.offset, glm::vec2(0.5f, 0));
    EXPECT_EQ(slot.scale, glm::vec2(2, 4));
    EXPECT_EQ(slot.rotation, 0.5f);
    EXPECT_EQ(m.normal_scale, 0.5f);
    // One texture as colours, one as numbers, the latter shared.
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_TRUE(scene.textures.at(slot.texture).srgb);
    EXPECT_FALSE(scene.textures.at(m.normal_texture.texture).srgb);
    EXPECT_EQ(m.normal_texture.texture, m.metallic_roughness_texture.texture);
    const auto& texture = scene.textures.at(slot.texture);
    EXPECT_EQ(texture.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 51}));
    EXPECT_EQ(texture.sampler.mag, scene::Filter::nearest);
    EXPECT_EQ(texture.sampler.min, scene::Filter::nearest);
    EXPECT_TRUE(texture.sampler.mipmaps);
    EXPECT_EQ(texture.sampler.wrap_s, scene::Wrap::clamp_to_edge);
    EXPECT_EQ(texture.sampler.wrap_t, scene::Wrap::mirrored_repeat);
}

TEST(GltfMaterials, ReadsTexturesInWebp) {
    auto builder = with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    builder.append("images", {{"uri", two_texels_webp}});
    builder.append("images", {{"uri", orange_webp}});
    const auto texture = [&](int image) {
        // The PNG beside it is for other programs.
        builder.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = image;
        return load(builder).textures.at(0);
    };
    const auto lossless = texture(1), lossy = texture(2);
    EXPECT_EQ(lossless.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 51}));
    EXPECT_TRUE(lossless.srgb);
    EXPECT_EQ(lossy.width, 5);
    EXPECT_EQ(lossy.height, 4);
    EXPECT_NEAR(lossy.rgba.at(0), 200, 8);
    EXPECT_EQ(lossy.rgba.at(3), 255);
    const std::string whole = two_texels_webp;
    for (const auto& damaged : {whole.substr(0, whole.size() - 12), whole.substr(0, whole.size() - 24)}) {
        builder.json["images"][1]["uri"] = damaged;
        EXPECT_THROW(texture(1), InputError) << damaged;
    }
}

TEST(GltfMaterials, TextureTransformsScaleThenRotateThenMove) {
    scene::TextureSlot slot;
    slot.scale = {2, 3};
    slot.rotation = glm::half_pi<float>();
    slot.offset = {10, 20};
    // (1, 0) becomes (2, 0), turns to (0, -2) [KHR_texture_transform's matrix], moves to (10, 18).
    const auto uv = scene::transformed_uv(slot, {1, 0});
    EXPECT_NEAR(uv.x, 10, 1e-5f);
    EXPECT_NEAR(uv.y, 18, 1e-5f);
}

TEST(GltfMaterials, BlendIsAMaskAtOneHalfWithAWarning) {
    const auto scene = load(with_material({{"alphaMode", "BLEND"}, {"alphaCutoff", 0.9}}));
    EXPECT_EQ(scene.materials.at(0).alpha_mode, scene::AlphaMode::mask);
    EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.5f);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].text.find("BLEND"), std::string::npos);
}

TEST(Opacity, BitmapsHoldWhatTheMaskLeaves) {
    auto builder = with_material({{"alphaMode", "MASK"},
                                  {"alphaCutoff", 0.25},
                                  {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const auto world = scene::flatten(load(builder), 0, 0);
    ASSERT_EQ(world.opacity.size(), 1u);
    EXPECT_EQ(world.opaque_triangles, 0u);
    const scene::Sampler repeat;
    const auto covered = [&](const scene::Sampler& sampler, float u) {
        return scene::is_covered(world, world.opacity[0], sampler, {u, 0.5f});
    };
    EXPECT_TRUE(covered(repeat, 0.25f));
    EXPECT_FALSE(covered(repeat, 0.75f));
    EXPECT_FALSE(covered(repeat, -0.25f));
    EXPECT_TRUE(covered(repeat, 1.25f));
    scene::Sampler clamp, mirror;
    clamp.wrap_s = scene::Wrap::clamp_to_edge;
    mirror.wrap_s = scene::Wrap::mirrored_repeat;
    EXPECT_TRUE(covered(clamp, -0.25f));
    EXPECT_FALSE(covered(clamp, 1.25f));
    EXPECT_TRUE(covered(mirror, -0.25f));
    EXPECT_FALSE(covered(mirror, 1.25f));
}

TEST(Opacity, TheFactorCountsAndTrianglesAreSorted) {
    auto builder = with_material(
        {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.4}}}}});
    builder.append("materials", {{"name", "opaque"}});
    builder.draw({{"POSITION", builder.triangle_positions()}});
    builder.json["meshes"][1]["primitives"][0]["material"] = 1;
    const auto world = scene::flatten(load(builder), 0, 0);
    EXPECT_EQ(world.opaque_triangles, 1u);
    EXPECT_EQ(world.triangle_materials, (std::vector<std::uint32_t>{1, 0}));
    ASSERT_EQ(world.ranges.size(), 2u);
    EXPECT_EQ(world.ranges[1].material, 0);
    EXPECT_EQ(world.ranges[1].first_triangle, 1u);
    EXPECT_FALSE(scene::is_covered(world, world.opacity.at(0), {}, {0.5f, 0.5f}));
}

TEST(GltfFiles, EmbeddedExternalAndBinaryAreTheSame) {
    GltfBuilder builder;
    builder.draw({{"POSITION", builder.triangle_positions()}});
    const test::TemporaryFolder folder;
    const auto embedded = scene::load_scene(write_file(folder, "a.gltf", builder.embedded_text()));
    const auto binary = scene::load_scene(write_file(folder, "a.glb", builder.glb_bytes()));
    write_file(folder, "with space.bin", std::string(builder.bytes.begin(), builder.bytes.end()));
    auto document = builder.json;
    document["buffers"] = {{{"byteLength", builder.bytes.size()}, {"uri", "with%20space.bin"}}};
    const auto file = write_file(folder, "b.gltf", document.dump());
    const auto external = scene::load_scene(file);
    EXPECT_EQ(embedded.meshes.at(0).positions, binary.meshes.at(0).positions);
    EXPECT_EQ(embedded.meshes.at(0).positions, external.meshes.at(0).positions);
    // The hash is of the bytes, the external ones included.
    EXPECT_EQ(external.content_hash.size(), 32u);
    EXPECT_EQ(scene::load_scene(file).content_hash, external.content_hash);
    auto changed = builder.bytes;
    changed[0] ^= 1;
    write_file(folder, "with space.bin", std::string(changed.begin(), changed.end()));
    EXPECT_NE(scene::load_scene(file).content_hash, external.content_hash);
}

}  // namespace
