#pragma once

#include <functional>

#include "renderers/gl/program.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes {

/// Declares what draw_scene reads.
void reads_scene(graph::PassBuilder& pass, const SceneBuffers& scene);

/// Draws all triangles of the materials for which `is_drawn` holds, with a program in use whose stages are
/// passes/scene/triangles.vert and one that includes passes/gbuffer/surface.glsl; binds textures and sets
/// the constants of these two files.
void draw_scene(const graph::PassContext& context, const SceneBuffers& scene, const gl::Program& program,
                bool normal_maps, const std::function<bool(const scene::Material&)>& is_drawn);

}  // namespace ir::passes
