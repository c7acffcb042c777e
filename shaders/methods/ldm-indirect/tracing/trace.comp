// Splits photons into some maps' directions and traces them. [Aalund15 §3.4, §4.2]
layout(local_size_x = 64) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "passes/ldm/entry_plane.glsl"
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/tracing/differentials.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"
#include "methods/ldm-indirect/tracing/landing.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
/// Of a chunk of primary photons and a batch of maps: distance, below 0 where nothing is stored, and normal.
layout(std430) writeonly buffer Hits { uvec2 hits[]; };
/// Photons to store of each primary photon and group of maps.
layout(std430) writeonly buffer Counts { uint counts[]; };
layout(std430) buffer AllShares { Shares all_shares[]; };
layout(std430) writeonly buffer Bases { uint bases[]; };
layout(std430) readonly buffer StoredCount { uint stored_count; };

/// Of the dispatch's maps. Uniforms cost software drivers one load for all invocations, buffers one for each.
uniform vec4 frame_rows[16 * 6];
uniform uint first_map, map_count;   // in the batch
uniform uint batch_maps, map_group, group_count;
uniform uint first_item, end_item, first_primary;  // among all primary photons; of the chunk
uniform uint chunk;

/// Of the differential after the split, and of the region of directions that it is widened by.
Spread spread_of(Primary p) {
    float region = params.footprint == FOOTPRINT_WIDENED ? sqrt(2.0 / float(params.directions)) : 0.0;
    return Spread(length(vec2(length(p.axis_u), length(p.axis_v))),
                  length(vec3(length(p.turn_u), length(p.turn_v), region)),
                  params.clipping != CLIPPING_NONE);
}

Landing trace(Primary p, MapFrame frame, uint map, bool forward, vec3 direction) {
    if (dot(p.normal_ws, direction) <= 0.0) return Landing(CAUSE_BELOW, 0.0, vec3(0));
    LdmHit hit = ldm_trace(frame, map, p.position_ws, p.normal_ws, forward, LDM_FAR_QUANTA);
    if (!hit.found) return Landing(CAUSE_LEFT, 0.0, vec3(0));
    float distance = max(hit.distance, 0.0);
    vec3 normal = -direction;
    bool has_surface = false;
    if (params.landing == LANDING_PLANE) {
        LdmPlane plane = ldm_plane(frame, map, hit.texel, params.resolution, hit.entry);
        has_surface = plane.known;
        if (has_surface) {
            vec3 x = ldm_project(frame, p.position_ws);
            float entry = hit.entry + dot(plane.slope, x.xy - vec2(hit.texel) - 0.5);
            distance = max(forward ? entry - x.z : x.z - entry, 0.0);
            normal = ldm_normal(frame, plane, direction);
        }
    }
    return landing(p.position_ws, direction, distance * frame.direction.w,
                   entry_error(p.normal_ws, direction, frame.step_u.xyz, frame.step_v.xyz), frame.step_u.xyz,
                   frame.step_v.xyz, spread_of(p), normal, has_surface);
}

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index == first_primary && map_group == 0u) bases[chunk] = stored_count;  // of the chunks before
    if (index >= end_item) return;
    Primary p = primaries[index];
    uint local = index - first_primary, slot = local * batch_maps + first_map, stored = 0u;
    bool splits = p.fate == PRIMARY_SPLITS && reflected_flux(p) != vec3(0);  // black and unlit surfaces do not
    for (uint i = 0u; i < map_count; ++i) {
        uint row = 6u * i;
        MapFrame frame = MapFrame(frame_rows[row], frame_rows[row + 1u], frame_rows[row + 2u], frame_rows[row + 3u],
                                  frame_rows[row + 4u], frame_rows[row + 5u]);
        float cosine = dot(p.shading_ws, frame.direction.xyz);
        bool forward = cosine > 0.0;
        Landing at = Landing(CAUSE_BELOW, 0.0, vec3(0));
        if (splits) {
            at = trace(p, frame, first_map + i, forward, forward ? frame.direction.xyz : -frame.direction.xyz);
            all_shares[index].part[at.cause] += abs(cosine) / p.cosine_sum;
            all_shares[index].photons[at.cause] += 1u;
        }
        bool is_stored = at.cause >= CAUSE_STORED;
        hits[slot + i] = uvec2(floatBitsToUint(is_stored ? at.distance : -1.0),
                               is_stored ? packed_direction(at.normal_ws) : 0u);
        stored += is_stored ? 1u : 0u;
    }
    counts[local * group_count + map_group] = stored;
}
