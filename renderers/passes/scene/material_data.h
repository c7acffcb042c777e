#pragma once

#include <vector>

#include "renderers/core/fields.h"
#include "renderers/scene/world.h"
#include "shaders/lib/coverage.glsl.h"
#include "shaders/lib/material.glsl.h"

namespace ir::passes {

std::vector<MaterialData> material_data(const scene::Scene& scene);
/// One element per material of the scene.
std::vector<OpacityData> opacity_data(const scene::Scene& scene, const scene::World& world);

}  // namespace ir::passes
