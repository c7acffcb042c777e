#pragma once

#include <functional>
#include <vector>

#include "renderers/core/light_kind.h"
#include "renderers/scene/scene.h"

namespace ir::scene {

/// Rectangles and disks, the lights that have an extent.
inline bool is_flat(const Light& light) {
    return light.type == LightType::rectangle || light.type == LightType::disk;
}

/// All that emits: the lights, then emissive materials that some mesh has, then the environment. Lights and
/// environment are the scene's, or stand for them. What is black is none. `visit` gets the index of the light
/// or the material, too.
void for_each_light_source(const Scene& scene, const std::vector<Light>& lights,
                           const Environment& environment,
                           const std::function<void(const LightSource&, std::size_t)>& visit);
std::vector<LightSource> light_sources(const Scene& scene, const std::vector<Light>& lights,
                                       const Environment& environment);

}  // namespace ir::scene
