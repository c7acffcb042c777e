#pragma once

#include <array>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/scene/scene.h"
#include "shaders/lib/light.glsl.h"

namespace ir::passes {

std::vector<LightData> light_data(const std::vector<scene::Light>& lights);

/// How many layers of "shadow.maps" a light takes: 1 for a directional light and a spot, 6 for a point light
/// and a spot too wide for one perspective map, 0 for lights with extent.
int shadow_layers(const scene::Light& light);

}  // namespace ir::passes
