#pragma once

#include "renderers/scene/gltf/document.h"
#include "renderers/scene/scene.h"

namespace ir::scene::gltf {

/// Fills materials, material_count and textures; a default material is appended where `needs_default`, and
/// where there is none at all. Returns the default material's index. Throws InputError.
int load_materials(Document& document, Scene& scene, bool needs_default);

}  // namespace ir::scene::gltf
