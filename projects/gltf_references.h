#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ir::projects {

/// The relative paths of buffers and images that a .gltf or .glb file refers to, in order of appearance,
/// percent-decoded; data URIs and absolute ones are left out. Empty for other files and for damaged ones:
/// what is wrong with them is the loader's matter.
std::vector<std::string> gltf_references(const std::filesystem::path& file);

}  // namespace ir::projects
