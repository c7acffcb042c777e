#pragma once

#include <vector>

#include "renderers/scene/gltf/document.h"
#include "renderers/scene/scene.h"

namespace ir::scene::gltf {

/// Turns all meshes into triangles: one scene mesh per primitive that has triangles. Returns, per glTF mesh,
/// the indices of its scene meshes. Primitives without a material get `default_material`. Throws InputError.
std::vector<std::vector<int>> load_meshes(Document& document, Scene& scene, int default_material);

}  // namespace ir::scene::gltf
