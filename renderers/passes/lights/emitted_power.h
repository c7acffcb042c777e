#pragma once

#include "renderers/scene/world.h"

/// What sources send altogether, W, mean of the channels: to divide photons among them.
namespace ir::passes {

/// A directional light or the environment shines through a disk of this radius about the scene's bounds, m.
float emission_disk_radius(const scene::World& world);

/// Exact.
float emitted_power(const scene::Light& light, float disk_radius);
/// Of both sides of all emissive triangles, textures taken for white.
float emitted_power_of_meshes(const scene::Scene& scene, const scene::World& world);
/// From all directions; of large maps only a part of the texels is looked at.
float emitted_power(const scene::Environment& environment, float disk_radius);

}  // namespace ir::passes
