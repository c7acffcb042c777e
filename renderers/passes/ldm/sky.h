#pragma once

#include "renderers/core/output.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/ldm/parameters.h"

namespace ir::passes::ldm {

/// The environment's light through layered depth maps. [Aalund15 §6, fig. 11]
struct Sky {
    graph::ImageRef light;  ///< "ldm.sky" rgba32f: Σ V cosθ L / Σ cosθ, the radiance of a white Lambertian
                            ///< surface, L the mean over each direction's region; A: frames
    graph::ImageRef sums;      ///< "ldm.sky_sums" rgba32f: Σ V cosθ L and Σ cosθ
    graph::ObjectRef regions;  ///< "ldm.regions": a std::vector<glm::vec3>, as region_radiance() has it
    Visibility visibility;
};

OutputDescription sky_output(const Condition& active_when);

/// Declares the images, and the pass "light of regions" (cpu).
Sky declare_sky(graph::GraphBuilder& builder, const MapsPointer& maps, const Visibility& visibility);
/// The pass "trace sky": adds the directions of a batch of maps, which was built. `shader` is the method's
/// program that includes passes/ldm/sky.glsl.
void trace_sky(graph::GraphBuilder& builder, const GBuffer& gbuffer, const MapsPointer& maps, int batch,
               const Sky& sky, const std::string& shader);
/// In its place for all maps: the pass "build and trace maps for the sky" (cpu), for has_host_body().
void trace_sky_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                       const MapsPointer& maps, const Sky& sky, const SelfHitRule& rule);
/// The pass "sky", when all maps were queried. `progressive`: the mean over the frames in which nothing
/// moved.
void finish_sky(graph::GraphBuilder& builder, const Sky& sky, bool progressive);

}  // namespace ir::passes::ldm
