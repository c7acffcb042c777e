#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/scene/gltf/scene_parts.h"
#include "renderers/scene/opening_camera.h"
#include "renderers/scene/scene.h"

namespace ir::scene {
namespace {

bool needs_default_material(const gltf::Document& document) {
    for (const auto& mesh : document.model.meshes)
        for (const auto& primitive : mesh.primitives)
            if (primitive.material < 0) return true;
    return false;
}

}  // namespace

Scene read_gltf(const std::string& file) {
    auto document = gltf::read_document(file);
    Scene scene;
    scene.name = file;
    scene.content_hash = document.content_hash;
    const int default_material = gltf::load_materials(document, scene, needs_default_material(document));
    const auto meshes = gltf::load_meshes(document, scene, default_material);
    const auto nodes = gltf::load_nodes(document, scene, meshes);
    gltf::load_skins(document, scene, nodes);
    gltf::load_animations(document, scene, nodes);
    gltf::load_cameras(document, scene, nodes);
    gltf::load_lights(document, scene, nodes);
    if (scene.instanced_triangles() == 0) document.warnings.add("the scene draws no triangles");
    scene.extensions = std::move(document.extensions);
    scene.variants = std::move(document.variants);
    scene.warnings = std::move(document.warnings.messages);
    return scene;
}

Scene load_gltf(const std::string& file) {
    auto scene = read_gltf(file);
    if (scene.cameras.empty()) scene.cameras.push_back(opening_camera(scene));
    return scene;
}

}  // namespace ir::scene
