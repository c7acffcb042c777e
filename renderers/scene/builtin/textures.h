#pragma once

#include "renderers/scene/scene.h"

/// Small procedural textures. Those of one surface come as a pair: colours and normals.
namespace ir::scene::builtin {

struct TexturePair {
    Texture colour, normal;
};

/// 5 × 16 bricks in running bond on a square.
TexturePair bricks();
/// 2 × 2 stone tiles, light and dark by turns, with small insets where they meet.
TexturePair tiles();
/// Woven stripes with a border at both ends of v.
Texture stripes(const std::string& name, glm::vec3 ground, glm::vec3 stripe);
/// A leaf on a transparent ground.
Texture leaf();
/// Wrought iron bars with scrolls on a transparent ground.
Texture grille();

}  // namespace ir::scene::builtin
