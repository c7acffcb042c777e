// The points of emission sets on their way through the steps of warping, as views show them.
#define PROBABILITY_MAP 0
#define HAAR_PYRAMID 1
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/emission/maps.glsl"

layout(std430) readonly buffer Sources { Source sources[]; };
layout(std430) readonly buffer Candidates { uint candidates[]; };
#include "methods/photon-mapping/emission/sources.glsl"

uniform int shown_source;            // -1: all
uniform int first_step, step_count;  // 0: before warping; 2 l + 1: horizontally at level l from the top, …
uniform uint points_without_light;
uniform uint first_item, end_item;  // of this dispatch

struct ShownPoint {
    uint source, index;  // of the source's set
    bool is_shown;
    WarpedPoint warped;
    bool survives;
};

ShownPoint shown_point(uint item) {
    ShownPoint s;
    bool no_light = source_count == 0u;
    if (item >= min(end_item, no_light ? points_without_light : all_points)) {
        s.is_shown = false;
        return s;
    }
    s.source = no_light ? 0u : source_of_item(item);
    s.index = no_light ? item : item - sources[s.source].first_point;
    s.is_shown = shown_source < 0 || int(s.source) == shown_source;
    EmissionSet set = no_light ? EmissionSet(points_without_light, stratum, strata,
                                             emission_shift(0u, uvec2(seed_low, seed_high)))
                               : emission_set_of(s.source);
    s.warped = WarpedPoint(uvec2(0), emission_point(set, s.index));
    s.survives = !no_light && (candidates[item] & CANDIDATE_SURVIVES) != 0u;
    return s;
}

/// One step further; points that are not warped stay where they are.
void take_step(inout ShownPoint s, int step) {
#if WARPS
    if (step == 0) return;
    int levels = findMSB(textureSize(probability_map, 0).x);
    int level = levels - 1 - (step - 1) / 2;
    bool vertically = (step & 1) == 0;
    uvec2 cell = vertically ? uvec2(s.warped.cell.x / 2u, s.warped.cell.y) : s.warped.cell;
    vec4 quad = quad_below(cell, int(s.source), level);
    s.warped = vertically ? warped_vertically(s.warped, quad) : warped_horizontally(s.warped, quad);
#endif
}

/// In the unit square, v downwards.
vec2 place_of(WarpedPoint p, int step) {
#if WARPS
    vec2 cells = exp2(vec2(float((step + 1) / 2), float(step / 2)));
    return (vec2(p.cell) + p.within) / cells;
#else
    return p.within;
#endif
}
