#pragma once

#include "renderers/core/transport.h"
#include "renderers/scene/scene.h"

namespace ir::methods::photon_mapping {

/// How many mirrors and sheets or bodies of clear glass a path may meet, beside those that scatter: none
/// where the scene has no such material. By the factors alone: where a texture makes a mirror of what its
/// factor does not, paths are cut after the first one, and counted. Each costs a wavefront.
int max_specular_events(const scene::Scene& scene, Transport::Materials model);

}  // namespace ir::methods::photon_mapping
