#pragma once

#include "renderers/passes/bounce/directions.h"

namespace ir::passes::bounce {

/// What the rays of the direction buffer met after everything was splatted; layers as "bounce.directions".
struct Samples {
    graph::ImageRef
        distance;  ///< "bounce.distance" r32f stack, m: |x_p − y| of the nearest hit; negative: no hit
    graph::ImageRef incoming;  ///< "bounce.incoming" stack. Ambient occlusion: r32f, V (1 open). Light:
                               ///< rgba32f, RGB L_in towards x_p in W/(m² sr), 0 without a hit
};

/// The two stacks. For ambient occlusion `see` fills the second one. Writers leave negative distances and no
/// light where there is no direction.
graph::ImageRef declare_distance(graph::GraphBuilder& builder, Batches& batches,
                                 const std::string& fingerprint = {});
graph::ImageRef declare_incoming(graph::GraphBuilder& builder, Batches& batches, Effects effects);

/// Declares the pass "visibility" of a batch, which fills `samples.incoming` for ambient occlusion: 1 without
/// a hit and from `transport.max_distance` on (0: no limit), below it as `transport.falloff` says. Directions
/// below the triangle's plane are closed whatever was met. [Nalbach15 §3.2]
void fill_visibility(graph::GraphBuilder& builder, const GBuffer& gbuffer, const Directions& directions,
                     const Samples& samples, const Transport& transport, const Batch& batch = {});

std::vector<OutputDescription> sample_outputs(const Condition& active_when, Effects effects = Effects::light);

}  // namespace ir::passes::bounce
