#pragma once

#include "renderers/graph/builder.h"

namespace ir::passes {

/// Declares the object "scene.host_textures", a vector of HostTexture with all levels; kept while the scene
/// stays. Who asks again in a frame gets the same.
graph::ObjectRef host_textures(graph::GraphBuilder& builder);

/// Declares the object "scene.host_surfaces", a SurfaceLookup with mip maps, with the passes that make it;
/// kept while the geometry stays. Who asks again in a frame gets the same: all name the same normal maps.
graph::ObjectRef host_surfaces(graph::GraphBuilder& builder, bool normal_maps);

}  // namespace ir::passes
