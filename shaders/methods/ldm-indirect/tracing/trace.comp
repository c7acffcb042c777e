// Splits photons into some maps' directions and traces them; with RAYS rays were traced before.
// [Aalund15 §3.4, §4.2]
layout(local_size_x = 64) in;
#include "passes/ldm/frames.glsl"
#ifndef RAYS
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "passes/ldm/entry_plane.glsl"
#endif
#include "methods/ldm-indirect/tracing/way.glsl"

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

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index == first_primary && map_group == 0u) bases[chunk] = stored_count;  // of the chunks before
    if (index >= end_item) return;
    Primary p = primaries[index];
    uint local = index - first_primary, slot = local * batch_maps + first_map, stored = 0u;
    bool is_split = sends_on(p);
    for (uint i = 0u; i < map_count; ++i) {
        uint row = 6u * i;
        MapFrame frame = MapFrame(frame_rows[row], frame_rows[row + 1u], frame_rows[row + 2u], frame_rows[row + 3u],
                                  frame_rows[row + 4u], frame_rows[row + 5u]);
        float cosine = dot(p.shading_ws, frame.direction.xyz);
        bool forward = cosine > 0.0;
        Landing at = Landing(CAUSE_BELOW, 0.0, vec3(0));
        if (is_split) {
            vec3 direction = forward ? frame.direction.xyz : -frame.direction.xyz;
#ifdef RAYS
            at = way_of(p, direction, slot + i);
#else
            at = way_of(p, direction, frame, first_map + i, forward);
#endif
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
