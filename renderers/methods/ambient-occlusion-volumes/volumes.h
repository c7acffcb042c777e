#pragma once

#include <functional>

#include "renderers/gl/program.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ambient-occlusion-volumes/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::ambient_occlusion_volumes {

/// What is needed to draw the volumes of all triangles.
struct Volumes {
    passes::SceneBuffers scene;
    passes::GBuffer gbuffer;
    graph::BufferRef occluders;  ///< "volumes.occluders", a triangle each: drawn u32, coverage f32
    std::int64_t triangles = 0;
    float reach = 0;  ///< m
    bool both_sides = true;
};

/// Declares the passes "cull volumes" and, where volumes are culled by what the picture shows, "picture
/// bounds".
Volumes declare_volumes(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                        const passes::GBuffer& gbuffer, const Parameters& parameters);

/// Declares what a pass reads to draw volumes, or to look at triangles.
void read_volumes(graph::PassBuilder& pass, const Volumes& volumes);

/// Sets the uniforms of triangle.glsl and origin.glsl, `reach` and `both_sides`.
void set_volumes(const graph::PassContext& context, const gl::Program& program, const Volumes& volumes);

/// volume.vert and volume.geom with this fragment shader.
gl::ProgramSource drawing_with(const std::string& fragments);

/// Draws the volumes of the triangles from `begin` to `end` into the framebuffer that is bound, with a
/// program that is in use.
void draw_volumes(const graph::PassContext& context, const gl::Program& program, std::int64_t begin,
                  std::int64_t end);

}  // namespace ir::methods::ambient_occlusion_volumes
