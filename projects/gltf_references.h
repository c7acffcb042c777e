#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ir::projects {

/// Whether the file can be read, and begins in no way as glTF does. Its other parts are not looked at.
bool is_no_gltf(const std::filesystem::path& file);

/// Paths of buffers and images that a glTF file refers to, in order of appearance; data URIs are left out.
struct GltfReferences {
    std::vector<std::string> read;     ///< relative, and the file may read them
    std::vector<std::string> refused;  ///< others
};
/// Empty for other files and for damaged ones: what is wrong with them is the loader's matter.
GltfReferences gltf_references(const std::filesystem::path& file);

/// Seconds until which a glTF file animates its nodes, by the bounds that the times of its keys must
/// have [glTF 2.0 §3.11]; 0: they stand still, as in other files and in damaged ones.
double gltf_animation_end(const std::filesystem::path& file);

}  // namespace ir::projects
