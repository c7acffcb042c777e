#pragma once

#include "renderers/graph/builder.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes::ldm {

/// The object "ldm.coarse_world": a scene::World of about `detail` (below 1) of the scene's triangles. Who
/// asks again in a frame gets the same.
graph::ObjectRef coarse_world(graph::GraphBuilder& builder, float detail);

/// What maps are built of: the scene itself, or where `detail` is below 1 its simplified triangles (passes
/// "simplify scene" and "coarse triangles", on the host). There are as many as before; those left over have
/// no area.
SceneBuffers map_scene(graph::GraphBuilder& builder, const SceneBuffers& scene, float detail);

}  // namespace ir::passes::ldm
