#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "renderers/passes/scene/triangle_chunks.h"

namespace ir::passes {

/// Declares what programs with passes/scene/triangles.vert and passes/scene/drawn_material.glsl read, without
/// the textures.
void reads_triangles(graph::PassBuilder& pass, const SceneBuffers& scene);
/// Declares the textures of all materials for passes/scene/drawn_material.glsl.
void reads_textures(graph::PassBuilder& pass, const SceneBuffers& scene);

/// Binds the textures that the material has; a bit for each, as the uniform `textures` wants it.
int bind_textures(const graph::PassContext& context, const SceneBuffers& scene,
                  const scene::Material& material);

/// With the program and the empty vertex array that are bound.
void draw_triangles(const graph::PassContext& context, const scene::MaterialRange& range);
void draw_triangles(const graph::PassContext& context, const std::vector<TriangleRun>& runs);

}  // namespace ir::passes
