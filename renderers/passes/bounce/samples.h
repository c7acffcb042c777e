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

/// The two stacks' descriptions, for methods that write them: `declare_distance` alone, and `incoming` made
/// of it by `visibility_of`, serve ambient occlusion. Writers leave negative distances and no light where
/// there is no direction.
graph::ImageRef declare_distance(graph::GraphBuilder& builder, int samples,
                                 const std::string& fingerprint = {});
graph::ImageRef declare_incoming_light(graph::GraphBuilder& builder, int samples);

/// Declares "bounce.incoming" for ambient occlusion and the pass "visibility": 1 without a hit and from
/// `transport.max_distance` on (0: no limit), below it as `transport.falloff` says. Directions below the
/// triangle's plane are closed whatever was met. [Nalbach15 §3.2]
graph::ImageRef visibility_of(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                              const Directions& directions, graph::ImageRef distance,
                              const Transport& transport);

std::vector<OutputDescription> sample_outputs(const Condition& active_when, Effects effects = Effects::light);

}  // namespace ir::passes::bounce
