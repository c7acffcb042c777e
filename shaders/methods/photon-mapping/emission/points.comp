// Finds for each point of the emission sets the texel that it is warped to, and whether a photon survives there.
// [Smal19 §5.3.2-5.3.3]
layout(local_size_x = 64) in;
#define PROBABILITY_MAP 3
#define HAAR_PYRAMID 4
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/emission/rsm.glsl"
#include "methods/photon-mapping/emission/maps.glsl"

layout(std430) readonly buffer Sources { Source sources[]; };
layout(std430) writeonly buffer Candidates { uint candidates[]; };
layout(std430) writeonly buffer Survivors { uint survivors[]; };
#include "methods/photon-mapping/emission/sources.glsl"

uniform uint first_item, end_item;

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint source = source_of_item(item);
    if (sources[source].points == 0u) {  // all maps are empty
        candidates[item] = packed_candidate(uvec2(0), source, false);
        survivors[item] = 0u;
        return;
    }
    vec2 point = emission_point(emission_set_of(source), item - sources[source].first_point);
    int resolution = textureSize(probability_map, 0).x, levels = findMSB(resolution);
#if WARPS
    WarpedPoint warped = warped_to_texel(point, int(source), levels);
#else
    WarpedPoint warped = unwarped_texel(point, resolution);
#endif
    float survival = rsm_survival(rsm_texel(ivec2(warped.cell), int(source)));
    bool survives = roulette_of_item(item) < survival;
    candidates[item] = packed_candidate(warped.cell, source, survives);
    survivors[item] = survives ? 1u : 0u;
}
