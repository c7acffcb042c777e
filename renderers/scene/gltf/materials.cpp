#include "renderers/scene/gltf/scene_parts.h"

#include <algorithm>
#include <set>

#include "renderers/scene/gltf/textures.h"

namespace ir::scene::gltf {
namespace {

using tinygltf::ExtensionMap;

const tinygltf::Value* find(const ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

float number(const tinygltf::Value& object, const char* key, float otherwise) {
    return object.Has(key) ? static_cast<float>(object.Get(key).GetNumberAsDouble()) : otherwise;
}

template <class Vector>
Vector numbers(const tinygltf::Value& object, const char* key, Vector otherwise) {
    if (!object.Has(key)) return otherwise;
    for (int i = 0; i < Vector::length(); ++i)
        otherwise[i] = static_cast<float>(object.Get(key).Get(i).GetNumberAsDouble());
    return otherwise;
}

float unit(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

class MaterialReader {
  public:
    MaterialReader(Document& document, TextureTable& textures) : document_(document), textures_(textures) {}

    Material read(const tinygltf::Material& source) {
        Material material;
        material.name = source.name;
        material.double_sided = source.doubleSided;
        read_alpha(source, material);
        read_surface(source, material);
        read_emission(source, material);
        read_volume(source, material);
        material.unlit = find(source.extensions, "KHR_materials_unlit") != nullptr;
        return material;
    }

  private:
    TextureSlot slot(int texture, int uv_set, const ExtensionMap& extensions, bool srgb) {
        TextureSlot result;
        if (texture < 0) return result;
        result.texture = textures_.add(texture, srgb);
        if (const auto* transform = find(extensions, "KHR_texture_transform")) {
            result.offset = numbers(*transform, "offset", result.offset);
            result.scale = numbers(*transform, "scale", result.scale);
            result.rotation = number(*transform, "rotation", 0);
            uv_set = static_cast<int>(number(*transform, "texCoord", static_cast<float>(uv_set)));
        }
        if (uv_set > 1) document_.warnings.add("texture coordinate sets beyond TEXCOORD_1 are ignored");
        result.uv_set = uv_set > 1 ? 0 : uv_set;
        return result;
    }

    template <class Info>
    TextureSlot slot(const Info& info, bool srgb) {
        return slot(info.index, info.texCoord, info.extensions, srgb);
    }

    void read_alpha(const tinygltf::Material& source, Material& material) {
        if (source.alphaMode == "MASK") {
            material.alpha_mode = AlphaMode::mask;
            material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
        } else if (source.alphaMode == "BLEND") {
            material.alpha_mode = AlphaMode::mask;
            material.alpha_cutoff = 0.5f;
            document_.warnings.add("alpha mode BLEND is drawn as a mask with cut-off 0.5");
        }
    }

    void read_surface(const tinygltf::Material& source, Material& material) {
        const auto& pbr = source.pbrMetallicRoughness;
        for (int i = 0; i < 4; ++i) material.base_colour[i] = unit(pbr.baseColorFactor[i]);
        material.metallic = unit(pbr.metallicFactor);
        material.roughness = unit(pbr.roughnessFactor);
        material.base_colour_texture = slot(pbr.baseColorTexture, true);
        material.metallic_roughness_texture = slot(pbr.metallicRoughnessTexture, false);
        material.normal_texture = slot(source.normalTexture, false);
        material.normal_scale = static_cast<float>(source.normalTexture.scale);
    }

    void read_emission(const tinygltf::Material& source, Material& material) {
        const auto* extension = find(source.extensions, "KHR_materials_emissive_strength");
        const float strength = extension ? number(*extension, "emissiveStrength", 1) : 1.0f;
        for (int i = 0; i < 3; ++i)
            material.emission[i] =
                std::clamp(static_cast<float>(source.emissiveFactor[i]) * strength, 0.0f, 1e30f);
        material.emission_texture = slot(source.emissiveTexture, true);
    }

    void read_volume(const tinygltf::Material& source, Material& material) {
        if (const auto* ior = find(source.extensions, "KHR_materials_ior"))
            material.ior = std::max(0.0f, number(*ior, "ior", 1.5f));
        if (const auto* extension = find(source.extensions, "KHR_materials_transmission")) {
            material.transmission = unit(number(*extension, "transmissionFactor", 0));
            material.transmission_texture = transmission_slot(*extension);
        }
        if (const auto* volume = find(source.extensions, "KHR_materials_volume")) {
            material.thickness = std::max(0.0f, number(*volume, "thicknessFactor", 0));
            material.attenuation_distance = std::max(0.0f, number(*volume, "attenuationDistance", 0));
            material.attenuation_colour = numbers(*volume, "attenuationColor", glm::vec3(1));
        }
    }

    TextureSlot transmission_slot(const tinygltf::Value& extension) {
        if (!extension.Has("transmissionTexture")) return {};
        const auto& info = extension.Get("transmissionTexture");
        ExtensionMap extensions;
        if (info.Has("extensions"))
            for (const auto& key : info.Get("extensions").Keys())
                extensions[key] = info.Get("extensions").Get(key);
        return slot(info.Get("index").GetNumberAsInt(), static_cast<int>(number(info, "texCoord", 0)),
                    extensions, false);
    }

    Document& document_;
    TextureTable& textures_;
};

/// A change of a material in a project needs a name. Equal names stay: such materials change together.
void name_unnamed(std::vector<Material>& materials) {
    std::set<std::string> taken;
    for (const auto& material : materials) taken.insert(material.name);
    std::size_t number = 0;
    for (auto& material : materials) {
        if (!material.name.empty()) continue;
        do {
            material.name = "material " + std::to_string(++number);
        } while (taken.count(material.name) != 0);
    }
}

}  // namespace

int load_materials(Document& document, Scene& scene, bool needs_default) {
    TextureTable textures(document);
    MaterialReader reader(document, textures);
    for (const auto& source : document.model.materials) scene.materials.push_back(reader.read(source));
    name_unnamed(scene.materials);
    scene.material_count = scene.materials.size();
    scene.textures = textures.decode();
    if (!needs_default && !scene.materials.empty()) return 0;
    scene.materials.push_back({});
    scene.materials.back().name = "default";
    return static_cast<int>(scene.materials.size()) - 1;
}

}  // namespace ir::scene::gltf
