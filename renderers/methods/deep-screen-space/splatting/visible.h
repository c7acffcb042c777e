#pragma once

#include "renderers/methods/deep-screen-space/splatting/splats.h"
#include "renderers/passes/raytracing/device_bvh.h"
#include "shaders/methods/deep-screen-space/splatting/exact.glsl.h"

namespace ir::methods::deep_screen_space {

/// What the splats with visibility of a frame are, and who won: between the steps of splat_visible.
struct VisibleSplats {
    Splats splats;
    passes::SceneBuffers scene;
    passes::DeviceBvh bvh;  ///< only where rays meet triangles
    passes::GBuffer gbuffer;
    passes::bounce::Directions directions;
    graph::ImageRef depth;  ///< "splats.depth" depth32f stack, z, a layer per sample and level (sample-major)
    graph::ImageRef winner;  ///< "splats.winner" r32ui stack likewise: 1 + surfel; 0: none
    graph::ImageRef exact;  ///< "splats.exact" rg32ui stack of the view, a layer per sample: exact.glsl; only
                            ///< where level 0 is exact
    graph::ImageRef nearest;  ///< "splats.nearest" r32ui stack likewise: 1 + surfel, or EXACT_HIT | triangle;
                              ///< 0: nothing was met
    graph::ImageRef hit_level;  ///< "splats.hit_level" r16f likewise: level of the nearest, -1: none
};

/// Constants of shaders/methods/deep-screen-space/splatting/visible_level.glsl.
struct VisibleLevel {
    InfluenceConstants influence;
    float coverage, max_distance;
    bool full_discs;
    IR_FIELDS(influence, coverage, max_distance, full_discs)
};
VisibleLevel visible_level(const Splats& splats);

/// Whether rays meet the scene's triangles, and not only discs.
inline bool needs_triangles(const Parameters& parameters) {
    return parameters.discs == Discs::seen || parameters.level0 == Level0::triangles;
}

/// What shaders/methods/deep-screen-space/splatting/accepted.glsl needs: defines and accesses.
gl::ProgramSource with_acceptance(gl::ProgramSource source, const Splats& splats);
void read_acceptance(graph::PassBuilder& pass, const VisibleSplats& visible);

/// Declares what decides of all levels: `nearest`, `hit_level` and the result, "bounce.distance".
graph::ImageRef declare_winning(graph::GraphBuilder& builder, VisibleSplats& visible,
                                const std::string& fingerprint = {});

/// Declares the pass "exact rays of level 0" and `exact`, on the device.
void trace_level0(graph::GraphBuilder& builder, VisibleSplats& visible);

/// Declares the pass "combine levels", which writes it. [Nalbach15 §4.2]
graph::ImageRef combine_levels(graph::GraphBuilder& builder, VisibleSplats& visible);

/// Declares the pass "light of the winners" and "bounce.incoming": what they send towards x_p.
graph::ImageRef resolve_light(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const passes::ShadowMaps& shadow, const VisibleSplats& visible,
                              graph::ImageRef distance);

/// Declares what only people look at: levels unshuffled, radiance of the winners on each level, implied ε.
void show_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, graph::ImageRef distance);

}  // namespace ir::methods::deep_screen_space
