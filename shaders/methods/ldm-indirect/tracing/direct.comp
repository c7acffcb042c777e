// Which primary photons the camera sees where they arrive. [Aalund15 §5.2]
layout(local_size_x = 64) in;
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/tracing/differentials.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"
#include "methods/ldm-indirect/tracing/landing.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
layout(std430) writeonly buffer Hits { uvec2 hits[]; };
layout(std430) writeonly buffer Counts { uint counts[]; };
layout(std430) writeonly buffer Fates { uint fates[]; };

uniform uint first_item, end_item;

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index >= end_item) return;
    Primary p = primaries[index];
    Landing at = Landing(CAUSES, 0.0, vec3(0));
    if (p.fate == PRIMARY_DEGENERATE) at.cause = CAUSE_DEGENERATE;
    if (p.fate == PRIMARY_SPLITS)
        at = landing(p.position_ws - p.path_length * p.direction_ws, p.direction_ws, p.path_length, 0.0, vec3(0),
                     vec3(0), Spread(length(vec2(length(p.axis_u), length(p.axis_v))), 0.0, false), p.normal_ws, true);
    bool is_stored = at.cause == CAUSE_STORED || at.cause == CAUSE_STORED_HIDDEN;
    hits[index] = uvec2(floatBitsToUint(at.distance), is_stored ? packed_direction(at.normal_ws) : 0u);
    counts[index] = is_stored ? 1u : 0u;
    fates[index] = at.cause;
}
