#pragma once

#include "renderers/methods/photon-mapping/stages.h"

namespace ir::methods::photon_mapping {

/// The same sample points as from an RSM, by rays from the lights: evenly over the sphere or the outer cone
/// of a light, or over the disc that the scene's bounds show to a directional one.  [Smal19 §5, fig. 5.1]
SamplePoints emit_traced(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                         const Parameters& parameters);

}  // namespace ir::methods::photon_mapping
