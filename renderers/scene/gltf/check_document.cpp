#include <algorithm>
#include <array>
#include <cstdio>

#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

struct Treatment {
    const char *name, *text;
};

constexpr std::array read_extensions{
    Treatment{gpu_instancing, "many instances of a mesh"},
    Treatment{meshopt_compression, "compressed vertices, indices and animations"},
    Treatment{"EXT_texture_webp", "textures in WebP"},
    Treatment{draco_compression, "compressed meshes"},
    Treatment{"KHR_lights_punctual", "point, spot and directional lights"},
    Treatment{"KHR_materials_emissive_strength", "scales the emission"},
    Treatment{"KHR_materials_ior", "index of refraction"},
    Treatment{"KHR_materials_transmission", "glass; rasterised methods draw what lies straight behind it"},
    Treatment{"KHR_materials_unlit", "unlit surfaces show their colour"},
    Treatment{materials_variants, "--variant chooses one; without it surfaces have their default materials"},
    Treatment{"KHR_materials_volume", "refraction and absorption within glass"},
    Treatment{"KHR_mesh_quantization", "vertices of small numbers"},
    Treatment{"KHR_texture_transform", "offset, rotation and scale of textures"}};

/// What is lost where a file does without them, too.
constexpr std::array ignored_extensions{
    Treatment{"EXT_texture_avif", "the PNG or JPEG beside it is read, where there is one"},
    Treatment{"KHR_animation_pointer", "only nodes and morph weights are animated"},
    Treatment{"KHR_materials_anisotropy", "highlights are round"},
    Treatment{"KHR_materials_clearcoat", "surfaces have no coat"},
    Treatment{"KHR_materials_dispersion", "glass refracts all colours alike"},
    Treatment{"KHR_materials_iridescence", "surfaces have no thin film"},
    Treatment{"KHR_materials_pbrSpecularGlossiness", "the metallic-roughness values are read"},
    Treatment{"KHR_materials_sheen", "cloth has no sheen"},
    Treatment{"KHR_materials_specular", "highlights have the strength of the index of refraction"},
    Treatment{"KHR_meshopt_compression", "the uncompressed data is read"},
    Treatment{"KHR_texture_basisu", "the PNG or JPEG beside it is read, where there is one"}};

template <class Table>
const Treatment* find(const Table& table, const std::string& name) {
    const auto same = [&](const Treatment& each) { return name == each.name; };
    const auto found = std::find_if(table.begin(), table.end(), same);
    return found == table.end() ? nullptr : &*found;
}

/// Major and minor of "2.0"; (-1, 0) for anything else.
std::pair<int, int> version_numbers(const std::string& version) {
    int major = 0, minor = 0, length = 0;
    if (std::sscanf(version.c_str(), "%4d.%4d%n", &major, &minor, &length) != 2) return {-1, 0};
    return length == static_cast<int>(version.size()) ? std::pair{major, minor} : std::pair{-1, 0};
}

std::vector<std::string> names_in(const Checking& checking, const char* array) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < checking.count(array); ++i) {
        const auto& name = checking.source[array][i];
        if (!name.is_string()) throw InputError(checking.file, element(array, i), "must be a string");
        names.push_back(name.get<std::string>());
    }
    return names;
}

}  // namespace

void Warnings::add(const std::string& text) {
    constexpr std::size_t max_warnings = 200;
    if (messages.size() >= max_warnings) return;
    const auto same = [&](const Message& message) { return message.text == text; };
    if (std::none_of(messages.begin(), messages.end(), same))
        messages.push_back({Severity::warning, "scene", text});
}

std::size_t Checking::count(const char* array) const {
    const auto found = source.find(array);
    if (found == source.end()) return 0;
    if (!found->is_array()) throw InputError(file, array, "must be a JSON array");
    return found->size();
}

void check_asset(Checking& checking) {
    CheckedObject document(checking.file, "", checking.source);
    CheckedObject asset(checking.file, "asset", document.required_object("asset"));
    const auto version = asset.required(asset.text("version"), "version");
    if (version_numbers(version).first != 2)
        asset.fail("version", "is \"" + one_line(version) + "\"; only glTF 2 is supported, export as 2.0");
    const auto minimum = asset.text("minVersion").value_or("2.0");
    if (version_numbers(minimum) != std::pair{2, 0})
        asset.fail("minVersion", "is \"" + one_line(minimum) + "\"; only glTF 2.0 is supported");
    checking.checked["asset"] = asset.result;
}

std::vector<Extension> check_extensions(Checking& checking) {
    const auto known = listed(words_of(read_extensions, &Treatment::name));
    for (const auto& name : names_in(checking, "extensionsRequired"))
        if (!find(read_extensions, name))
            throw InputError(
                checking.file, "extensionsRequired",
                one_line(name) + " is not supported; export without it (supported: " + known + ")");
    std::vector<Extension> extensions;
    constexpr std::size_t max_extensions = 200;
    for (const auto& name : names_in(checking, "extensionsUsed")) {
        const auto* read = find(read_extensions, name);
        const auto* ignored = find(ignored_extensions, name);
        if (!read) checking.warnings.add("extension " + one_line(name) + " is not supported and was ignored");
        if (extensions.size() < max_extensions)
            extensions.push_back({one_line(name), read != nullptr,
                                  read      ? read->text
                                  : ignored ? ignored->text
                                            : "unknown"});
    }
    return extensions;
}

}  // namespace ir::scene::gltf
