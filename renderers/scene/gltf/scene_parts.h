#pragma once

#include <vector>

#include "renderers/scene/gltf/document.h"
#include "renderers/scene/scene.h"

namespace ir::scene::gltf {

/// All that a file says, as load_gltf(); cameras may be empty.
Scene load_without_camera(const std::string& file);

/// Turns all meshes into triangles: one scene mesh per primitive that has triangles. Returns, per glTF mesh,
/// the indices of its scene meshes. Primitives without a material get `default_material`. Throws InputError.
std::vector<std::vector<int>> load_meshes(Document& document, Scene& scene, int default_material);

/// Fills materials, material_count and textures; a default material is appended where `needs_default`, and
/// where there is none at all. Returns the default material's index. Throws InputError.
int load_materials(Document& document, Scene& scene, bool needs_default);

/// Fills Scene::nodes with the default scene's tree, parents first. `meshes`: scene meshes per glTF mesh.
/// Returns the scene node per glTF node, -1 for those outside the default scene. Throws InputError.
std::vector<int> load_nodes(Document& document, Scene& scene, const std::vector<std::vector<int>>& meshes);

/// Fills the skins that shown nodes have, and checks that their joints are shown and enough for the meshes.
/// Throws InputError.
void load_skins(Document& document, Scene& scene, const std::vector<int>& nodes);

/// Channels of all animations; of several for one property of a node the first wins. Throws InputError.
void load_animations(Document& document, Scene& scene, const std::vector<int>& nodes);

/// Cameras and lights of the default scene's nodes.
void load_cameras(Document& document, Scene& scene, const std::vector<int>& nodes);
void load_lights(Document& document, Scene& scene, const std::vector<int>& nodes);

}  // namespace ir::scene::gltf
