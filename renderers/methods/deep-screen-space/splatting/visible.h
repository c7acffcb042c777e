#pragma once

#include "renderers/methods/deep-screen-space/splatting/splats.h"
#include "renderers/passes/bounce/samples.h"
#include "renderers/passes/raytracing/device_bvh.h"
#include "renderers/passes/scene/hit_surfaces.h"
#include "shaders/methods/deep-screen-space/splatting/exact.glsl.h"

namespace ir::methods::deep_screen_space {
/// Splatting with visibility: per sample and level the nearest surfel along the pixel's direction; of levels
/// the finest that has a hit. Stacks are those of a batch of samples, or of all. [Nalbach15 §3.2, §4.2, §4.3]
struct VisibleSplats {
    Splats splats;
    passes::SceneBuffers scene;
    passes::ShadowMaps shadow;
    passes::DeviceBvh bvh;          ///< only where rays meet triangles
    passes::HitSurfaces triangles;  ///< only where glass lets rays through
    passes::GBuffer gbuffer;
    passes::bounce::Directions directions;
    graph::ImageRef depth;  ///< "splats.depth" depth32f stack, z, a layer per sample and level (sample-major)
    graph::ImageRef winner;  ///< "splats.winner" r32ui stack likewise: 1 + surfel; 0: none
    graph::ImageRef exact;  ///< "splats.exact" rg32ui stack of the view, a layer per sample: exact.glsl; only
                            ///< where level 0 is exact
    graph::ImageRef nearest;  ///< "splats.nearest" r32ui stack likewise: 1 + surfel, or EXACT_HIT | triangle;
                              ///< 0: nothing was met
    graph::ImageRef hit_level;     ///< "splats.hit_level" r16f likewise: level of the nearest, -1: none
    graph::ImageRef source_light;  ///< "splats.source_light" rgba32f likewise: what winners send of sources
                                   ///< with an extent beyond what discs store; only where there are such, on
                                   ///< the device
    passes::bounce::Samples samples;  ///< the result
};

/// Declares directions, stacks and result.
VisibleSplats declare_visible(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                              const Hierarchy& hierarchy, const Surfels& surfels,
                              const Parameters& parameters, passes::bounce::Batches& batches);
/// Declares the passes that choose directions of a batch, splat, and shade the winners on their way to the
/// pixel where the paths are of light.
void splat_visible(graph::GraphBuilder& builder, VisibleSplats visible, const passes::bounce::Batch& batch);
/// With the stacks of all samples.
VisibleSplats whole(VisibleSplats visible, const passes::bounce::Batches& batches);
/// Declares what people look at, of all samples.
void show_visible(graph::GraphBuilder& builder, const VisibleSplats& visible);

/// Constants of shaders/methods/deep-screen-space/splatting/visible_hit.glsl.
struct VisibleLevel {
    InfluenceConstants influence;
    float coverage, max_distance;
    bool full_discs;
    IR_FIELDS(influence, coverage, max_distance, full_discs)
};
VisibleLevel visible_level(const Splats& splats);

/// Whether rays meet the scene's triangles, and not only discs.
inline bool needs_triangles(const Parameters& parameters) {
    return parameters.discs == Discs::seen || parameters.borders == Borders::clipped ||
           parameters.level0 == Level0::triangles;
}

/// What shaders/methods/deep-screen-space/splatting/accepted.glsl needs: defines and accesses.
gl::ProgramSource with_acceptance(gl::ProgramSource source, const Splats& splats);
void read_acceptance(graph::PassBuilder& pass, const VisibleSplats& visible);

/// Accesses of glass.glsl and of the normals of triangles.
void read_glass(graph::PassBuilder& pass, const VisibleSplats& visible);

/// Declares the pass "exact rays of level 0", on the device. `batch`: the end of its name, as in all that
/// follow.
void trace_level0(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch);

/// Declares the pass "combine levels": what decides of all levels. [Nalbach15 §4.2]
void combine_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch);

/// Declares the pass "light of the winners": what they send towards x_p.
void resolve_light(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch);

/// Declares what only people look at: levels unshuffled, radiance of the winners on each level, implied ε.
void show_levels(graph::GraphBuilder& builder, const VisibleSplats& visible);

/// Declares the pass "light samples of winners", which fills `source_light` for the device.
void sample_winners_sources(graph::GraphBuilder& builder, const VisibleSplats& visible,
                            const std::string& batch);

/// "bounce.incoming" by the host's threads, as resolve.comp has it: what the winners send.
void resolve_light_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible,
                           const std::string& batch);

/// Rays of pixels against ray-tracing scenes of discs, in place of splats: the same winners, but for rounding
/// at the edges of discs. Writes `nearest`, `hit_level` and the distance; and `depth` and `winner`, which run
/// only for those who look at them.
void splat_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch);

std::vector<OutputDescription> visible_outputs();  ///< only with visibility

}  // namespace ir::methods::deep_screen_space
