#pragma once

#include "renderers/passes/lights/entry_box.h"
#include "renderers/scene/world.h"

/// What sources send altogether, W, mean of the channels: to divide photons among them.
namespace ir::passes {

/// Exact; directional lights shine through the box.
float emitted_power(const scene::Light& light, const EntryBox& box);
/// Of both sides of all emissive triangles, textures taken for white.
float emitted_power_of_meshes(const scene::Scene& scene, const scene::World& world);
/// Of those of one material.
float emitted_power_of_material(const scene::Scene& scene, const scene::World& world, int material);
/// From all directions through the box, as if a map shone evenly; of large ones only a part of the texels is
/// looked at.
float emitted_power(const scene::Environment& environment, const EntryBox& box);

}  // namespace ir::passes
