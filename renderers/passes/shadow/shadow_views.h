#pragma once

#include <vector>

#include "renderers/core/fields.h"
#include "renderers/scene/world.h"
#include "shaders/passes/shadow/shadow.glsl.h"

namespace ir::passes {

/// The views of all lights in order of layer. Perspective for spots (the outer cone) and the six faces of
/// point lights (+x, -x, +y, -y, +z, -z); orthographic about the world's bounds for directional lights.
std::vector<ShadowViewData> shadow_views(const scene::World& world, int resolution);

}  // namespace ir::passes
