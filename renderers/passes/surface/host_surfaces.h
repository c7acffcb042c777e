#pragma once

#include "renderers/graph/builder.h"

namespace ir::passes {

/// Declares the object "scene.host_surfaces", a SurfaceLookup with mip maps, with the passes that make it;
/// kept while the geometry stays. Who asks again in a frame gets the same: all name the same normal maps.
graph::ObjectRef host_surfaces(graph::GraphBuilder& builder, bool normal_maps);

}  // namespace ir::passes
