#pragma once

#include "renderers/methods/deep-screen-space/splatting/splats.h"
#include "renderers/methods/deep-screen-space/surfels/senders.h"
#include "renderers/passes/bounce/receiver.h"

namespace ir::methods::deep_screen_space {
/// What the parts of one additive splatting share.
struct Additive {
    Splats splats;
    passes::bounce::Receivers receivers;
    graph::ImageRef splatted;  ///< "additive.splatted": occlusion, or light by a white Lambert part
    graph::ImageRef glossy;    ///< "additive.glossy": light by microfacets; none where materials have none
    SenderInputs senders;

    bool is_light() const { return receivers.options.light; }
    bool has_highlights() const { return is_light() && sends_highlights(parameters()); }
    bool has_gloss() const { return glossy.index >= 0; }
    const Parameters& parameters() const { return splats.parameters; }
};

/// Constants of additive_share.glsl but for those of influence.glsl.
struct ShareConstants {
    SenderConstants senders;
    passes::bounce::ReceiverConstants receiver;
    bool black_backs;
    float falloff_distance;
    IR_FIELDS(senders, receiver, black_backs, falloff_distance)
};
ShareConstants share_constants(const graph::FrameInputs& inputs, const Additive& additive);
gl::ProgramSource with_share(gl::ProgramSource source, const Additive& additive);

/// Declares what explains the picked pixel: all surfels that were added to it, found by a search over all.
void explain_additive(graph::GraphBuilder& builder, const Additive& additive);

/// Splatting without visibility: every surfel adds its form factor, or the light that it sends there, on one
/// level by distance; levels are blurred (by the blur's parameters, as many pixels of the level) and added.
/// The image that `text` describes: accessibility r32f or reflected radiance rgba32f. [Nalbach14]
graph::ImageRef splat_additive(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                               const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                               const Hierarchy& hierarchy, const Surfels& surfels,
                               const Parameters& parameters, graph::ResourceText text);

std::vector<OutputDescription> additive_outputs();  ///< only without visibility

}  // namespace ir::methods::deep_screen_space
