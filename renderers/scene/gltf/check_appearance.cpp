#include "renderers/core/error.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

constexpr std::int64_t max_uv_set = 255;

/// Copies one texture reference with KHR_texture_transform to `owner`.
void check_texture_info(Checking& checking, CheckedObject& owner, const char* key) {
    const auto* source = owner.object(key);
    if (!source) return;
    CheckedObject info(checking.file, owner.place(key), *source);
    info.required(info.index("index", checking.count("textures"), "textures"), "index");
    info.integer("texCoord", 0, max_uv_set);
    info.number("scale");
    if (const auto* extension = info.extension("KHR_texture_transform")) {
        CheckedObject transform(checking.file, info.place("extensions.KHR_texture_transform"), *extension);
        transform.numbers("offset", 2);
        transform.numbers("scale", 2);
        transform.number("rotation");
        transform.integer("texCoord", 0, max_uv_set);
        info.result["extensions"]["KHR_texture_transform"] = transform.result;
    }
    owner.result[key] = info.result;
}

template <class Check>
void check_extension(Checking& checking, CheckedObject& owner, const char* name, Check check) {
    const auto* source = owner.extension(name);
    if (!source) return;
    CheckedObject extension(checking.file, owner.place(std::string("extensions.") + name), *source);
    check(extension);
    owner.result["extensions"][name] = extension.result;
}

void check_metallic_roughness(Checking& checking, CheckedObject& material) {
    const auto* source = material.object("pbrMetallicRoughness");
    if (!source) return;
    CheckedObject pbr(checking.file, material.place("pbrMetallicRoughness"), *source);
    pbr.numbers("baseColorFactor", 4);
    pbr.number("metallicFactor");
    pbr.number("roughnessFactor");
    check_texture_info(checking, pbr, "baseColorTexture");
    check_texture_info(checking, pbr, "metallicRoughnessTexture");
    material.result["pbrMetallicRoughness"] = pbr.result;
}

}  // namespace

void check_textures(Checking& checking) {
    checking.for_each("samplers", [](CheckedObject& sampler) {
        for (const auto* key : {"magFilter", "minFilter", "wrapS", "wrapT"}) sampler.integer(key, 0, 65535);
    });
    checking.for_each("textures", [&](CheckedObject& texture) {
        texture.text("name");
        texture.index("sampler", checking.count("samplers"), "samplers");
        texture.index("source", checking.count("images"), "images");
        // The image that it names stands for the other, which is for programs that do not know the extension.
        if (const auto* source = texture.extension("EXT_texture_webp")) {
            CheckedObject webp(checking.file, texture.place("extensions.EXT_texture_webp"), *source);
            webp.index("source", checking.count("images"), "images");
            if (webp.result.contains("source")) texture.result["source"] = webp.result["source"];
        }
    });
}

void check_materials(Checking& checking) {
    checking.for_each("materials", [&](CheckedObject& material) {
        material.text("name");
        material.numbers("emissiveFactor", 3);
        material.text("alphaMode");
        material.number("alphaCutoff");
        material.boolean("doubleSided");
        check_metallic_roughness(checking, material);
        check_texture_info(checking, material, "normalTexture");
        check_texture_info(checking, material, "emissiveTexture");
        check_extension(checking, material, "KHR_materials_unlit", [](CheckedObject&) {});
        check_extension(checking, material, "KHR_materials_ior", [](CheckedObject& e) { e.number("ior"); });
        check_extension(checking, material, "KHR_materials_emissive_strength",
                        [](CheckedObject& e) { e.number("emissiveStrength"); });
        check_extension(checking, material, "KHR_materials_transmission", [&](CheckedObject& e) {
            e.number("transmissionFactor");
            check_texture_info(checking, e, "transmissionTexture");
        });
        check_extension(checking, material, "KHR_materials_volume", [&](CheckedObject& e) {
            e.number("thicknessFactor");
            e.number("attenuationDistance");
            e.numbers("attenuationColor", 3);
            if (e.object("thicknessTexture"))
                checking.warnings.add(
                    "thickness textures are ignored; the thickness factor applies everywhere");
        });
    });
}

}  // namespace ir::scene::gltf
