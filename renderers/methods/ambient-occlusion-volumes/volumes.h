#pragma once

#include <functional>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/graph/benchmark.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ambient-occlusion-volumes/parameters.h"
#include "renderers/passes/bounce/samples.h"
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

/// Constants of shaders that look at triangles: of triangle.glsl, and which volumes they have.
struct TriangleConstants {
    unsigned opaque_triangles;
    float reach;
    bool both_sides;
    IR_FIELDS(opaque_triangles, reach, both_sides)
};
TriangleConstants triangle_constants(const graph::FrameInputs& inputs, const Volumes& volumes);

/// Constants of hull.glsl.
struct Hull {
    TriangleConstants triangles;
    glm::vec4 viewer_ws;
    glm::vec3 view_axis_ws;
    glm::vec2 pixel_size;
    glm::mat4 clip_from_world;
    IR_FIELDS(triangles, viewer_ws, view_axis_ws, pixel_size, clip_from_world)
};
Hull hull(const graph::FrameInputs& inputs, const Volumes& volumes);

/// volume.vert and volume.geom with this fragment shader; they take the constants of Hull.
gl::ProgramSource drawing_with(const std::string& fragments);

/// Draws the volumes of the triangles from `begin` to `end` into the framebuffer that is bound, with a
/// program that is in use and has its constants.
void draw_volumes(const graph::PassContext& context, std::int64_t begin, std::int64_t end);

/// Declares the passes "additive" and "compensate": "volumes.sum", the form factors of all triangles with
/// their fall-off, and "volumes.raw", the accessibility that is made of it, which is returned. [McGuire10]
graph::ImageRef add_up(graph::GraphBuilder& builder, const Volumes& volumes, Transport::Falloff falloff);

/// The same on the host's threads, without drawing: the pass "additive", which fills `sum`.
void add_up_on_host(graph::GraphBuilder& builder, const Volumes& volumes, Transport::Falloff falloff,
                    graph::ImageRef sum);

/// Declares the pass "count volumes".
void count_volumes(graph::GraphBuilder& builder, const Volumes& volumes);

std::vector<OutputDescription> additive_outputs();
std::vector<OutputDescription> count_outputs();

struct Bounced {
    graph::ImageRef distance;  ///< bounce::Samples
    graph::ImageRef winner;    ///< "volumes.winner" r32ui stack: 1 + triangle, 0 none
    graph::ImageRef depth;     ///< "volumes.depth" depth32f stack: z = |x − y|² / r²; 1: none
};

/// Declares the pass "bounced z": for each sample the nearest triangle along its direction. [Nalbach15 §3.2]
Bounced find_nearest(graph::GraphBuilder& builder, const Volumes& volumes,
                     const passes::bounce::Directions& directions);

/// The same on the host's threads: rays through the ray-tracing scene, without volumes. Declares the pass
/// that fills `bounced`.
void find_nearest_on_host(graph::GraphBuilder& builder, const Volumes& volumes,
                          const passes::bounce::Directions& directions, const Bounced& bounced);

std::vector<OutputDescription> bounced_outputs();

/// Declares "volumes.explain.triangles", the triangles in whose volumes the picked pixel's point lies, in
/// their order, and the passes that fill it. Without visibility `directions` and `bounced` are null.
void explain(graph::GraphBuilder& builder, const Volumes& volumes,
             const passes::bounce::Directions* directions, const Bounced* bounced);

std::vector<OutputDescription> explanation_outputs();

/// "ambient-occlusion-volumes": the additive and the bounced form on one scene, over samples and distances.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ambient_occlusion_volumes
