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

/// Returns the texture's index.
int add_texture(Scene& scene, Texture texture);
/// Appends a dielectric with the textures of the pair that have texels; `period`: metres that their side
/// covers. Returns its index.
int add_textured(Scene& scene, const std::string& name, TexturePair pair, float period,
                 float roughness = 0.85f);
/// Gives tangents to all meshes whose material has a normal map.
void add_tangents(Scene& scene);

}  // namespace ir::scene::builtin
