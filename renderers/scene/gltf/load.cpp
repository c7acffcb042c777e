#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/scene_parts.h"
#include "renderers/scene/opening_camera.h"
#include "renderers/scene/scene.h"

namespace ir::scene {
namespace gltf {
namespace {

bool needs_default_material(const Document& document) {
    for (const auto& mesh : document.model.meshes)
        for (const auto& primitive : mesh.primitives)
            if (primitive.material < 0) return true;
    return false;
}

}  // namespace

Scene load_without_camera(const std::string& file) {
    auto document = read_document(file);
    Scene scene;
    scene.name = file;
    scene.content_hash = document.content_hash;
    const int default_material = load_materials(document, scene, needs_default_material(document));
    const auto meshes = load_meshes(document, scene, default_material);
    const auto nodes = load_nodes(document, scene, meshes);
    load_skins(document, scene, nodes);
    load_animations(document, scene, nodes);
    load_cameras(document, scene, nodes);
    load_lights(document, scene, nodes);
    if (scene.instanced_triangles() == 0) document.warnings.add("the scene draws no triangles");
    scene.extensions = std::move(document.extensions);
    scene.variants = std::move(document.variants);
    scene.warnings = std::move(document.warnings.messages);
    return scene;
}

}  // namespace gltf

Scene load_gltf(const std::string& file) {
    auto scene = gltf::load_without_camera(file);
    if (scene.cameras.empty()) scene.cameras.push_back(opening_camera(scene));
    return scene;
}

}  // namespace ir::scene
