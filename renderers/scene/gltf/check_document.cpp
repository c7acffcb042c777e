#include <algorithm>
#include <cstdio>
#include <set>

#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/scene/gltf/check.h"
#include "renderers/scene/gltf/source.h"

namespace ir::scene::gltf {
namespace {

const std::set<std::string>& supported_extensions() {
    static const std::set<std::string> names{"KHR_lights_punctual",   "KHR_materials_emissive_strength",
                                             "KHR_materials_ior",     "KHR_materials_transmission",
                                             "KHR_materials_unlit",   "KHR_materials_volume",
                                             "KHR_mesh_quantization", "KHR_texture_transform"};
    return names;
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

void check_extensions(Checking& checking) {
    const auto& supported = supported_extensions();
    const auto known = listed({supported.begin(), supported.end()});
    for (const auto& name : names_in(checking, "extensionsRequired"))
        if (!supported_extensions().contains(name))
            throw InputError(
                checking.file, "extensionsRequired",
                one_line(name) + " is not supported; export without it (supported: " + known + ")");
    for (const auto& name : names_in(checking, "extensionsUsed"))
        if (!supported_extensions().contains(name))
            checking.warnings.add("extension " + one_line(name) + " is not supported and was ignored");
}

}  // namespace ir::scene::gltf
