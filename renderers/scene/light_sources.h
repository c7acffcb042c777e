#pragma once

#include <vector>

#include "renderers/core/light_kind.h"
#include "renderers/scene/scene.h"

namespace ir::scene {

/// All that emits: the lights, then emissive materials that some mesh has, then the environment. Lights and
/// environment are the scene's, or stand for them. What is black is none.
std::vector<LightSource> light_sources(const Scene& scene, const std::vector<Light>& lights,
                                       const Environment& environment);

}  // namespace ir::scene
