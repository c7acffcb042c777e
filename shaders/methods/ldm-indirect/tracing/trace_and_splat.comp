// Traces photons through maps and splats them at once: none is stored. A work group has those of one primary photon
// along some maps' directions: each invocation traces one, then all of them splat one after the other.
// [Aalund15 §5.2]
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"
#include "passes/ldm/trace.glsl"
#include "passes/ldm/self_hit.glsl"
#include "passes/ldm/entry_plane.glsl"
#include "methods/ldm-indirect/records.glsl"
#include "methods/ldm-indirect/tracing/way.glsl"
#include "methods/ldm-indirect/tracing/overhang.glsl"
#include "methods/ldm-indirect/tracing/child.glsl"
#include "methods/ldm-indirect/splatting/atomic_add.glsl"

// C++: ir::methods::ldm_indirect::one_pass_lanes
const uint ONE_PASS_LANES = 32u;
/// Of a footprint's rectangle that are added in one loop: llvmpipe ends loops after 65,535 turns.
const uint PIXELS_AT_ONCE = 60000u * ONE_PASS_LANES;

layout(local_size_x = ONE_PASS_LANES) in;
layout(std430) readonly buffer Primaries { Primary primaries[]; };

uniform uint first_item, end_item;                   // primary photons
uniform uint first_frame, first_map, maps_together;  // among all maps; in the batch

shared Photon traced[ONE_PASS_LANES];
shared bool is_stored[ONE_PASS_LANES];

/// False: nothing is stored.
bool trace_one(Primary p, uint i, out Photon photon) {
    MapFrame frame = ldm_frames[first_frame + i];
    bool forward = dot(p.shading_ws, frame.direction.xyz) > 0.0;
    vec3 direction = forward ? frame.direction.xyz : -frame.direction.xyz;
    Landing at = way_of(p, direction, frame, first_map + i, forward);
    if (at.cause < CAUSE_STORED) return false;
    photon = photon_of(p, first_frame + i, at.distance, packed_direction(at.normal_ws));
    if (params.overhang == OVERHANG_RETURNED && params.clipping == CLIPPING_NONE)
        photon.leg |= part_beyond(photon, frame, first_map + i, params.resolution) << LEG_BEYOND_SHIFT;
    return true;
}

void main() {
    uint me = gl_LocalInvocationID.x, index = first_item + gl_WorkGroupID.x;
    is_stored[me] = false;
    if (index < end_item && me < maps_together && sends_on(primaries[index])) {
        Photon photon;
        is_stored[me] = trace_one(primaries[index], me, photon);
        traced[me] = photon;
    }
    barrier();
    uint pixels = uint(size_px.x) * uint(size_px.y);
    for (uint i = 0u; i < maps_together; ++i) {
        if (!is_stored[i]) continue;
        Footprint f = footprint_of(traced[i]);
        for (uint first = 0u; first < pixels; first += PIXELS_AT_ONCE)
            splat_atomically(f, first + me, ONE_PASS_LANES, first + PIXELS_AT_ONCE);
    }
}
