#pragma once

#include "renderers/core/parameter.h"
#include "renderers/passes/ldm/builder.h"

namespace ir::passes::ldm {

/// Counts from 0 in the order of the choices of parameter "self_hit".
enum class SelfHit { tangent_plane, normal_offset };

/// What every method that queries layered depth maps lets people choose.
struct MapParameters : Options {
    SelfHit self_hit = SelfHit::tangent_plane;
    float self_hit_tolerance = 3;
    float slope_tolerance = 0.35f;
    float max_dip = 1;
    float normal_offset = 1;
};

/// Which hits a method queries.
enum class QueriedHits {
    nearest,  ///< what lies first along a ray
    any       ///< also whether anything lies there at all, for which storage "outermost" is enough
};

/// Directions, resolution, storage and builder.
ParameterTable<MapParameters> map_parameters(QueriedHits hits = QueriedHits::nearest);
/// The self-hit rule: what shaders/passes/ldm/self_hit.glsl reads.
ParameterTable<MapParameters> self_hit_parameters();

}  // namespace ir::passes::ldm
