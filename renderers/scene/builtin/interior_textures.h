#pragma once

#include "renderers/scene/builtin/textures.h"

/// Procedural textures of rooms and what stands in them.
namespace ir::scene::builtin {

/// Loops of wool in a loose pattern of two tones.
TexturePair carpet();
/// Planks along u, with grain.
TexturePair planks();
/// Grain along u, without joints.
Texture wood(const std::string& name, glm::vec3 light, glm::vec3 dark);
/// Rough plaster: normals alone.
Texture plaster();
/// Checks of two colours, woven.
Texture checks(const std::string& name, glm::vec3 ground, glm::vec3 check);
/// The skin of an orange: normals alone.
Texture peel();

}  // namespace ir::scene::builtin
