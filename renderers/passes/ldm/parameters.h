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

/// What a method offers beside lists of plain nodes.
struct MapChoices {
    bool outermost = false;  ///< storage "outermost": it also asks whether anything lies along a ray at all
    bool sloped = false;     ///< nodes with slopes, in storages that may keep them
};

/// Directions, resolution, storage and builder.
ParameterTable<MapParameters> map_parameters(const MapChoices& choices = {});
/// When a parameter of slopes counts: where the storage may keep them.
Condition keeps_slopes();
/// The self-hit rule: what shaders/passes/ldm/self_hit.glsl reads.
ParameterTable<MapParameters> self_hit_parameters();

}  // namespace ir::passes::ldm
