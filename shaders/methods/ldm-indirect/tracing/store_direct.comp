// Packs the photons that came directly from lights.
layout(local_size_x = 64) in;
#include "methods/ldm-indirect/records.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
layout(std430) readonly buffer Hits { uvec2 hits[]; };
layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Photons { Photon photons[]; };

uniform uint first_item, end_item, capacity;

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index >= end_item || counts[index] == 0u || places[index] >= capacity) return;
    Primary p = primaries[index];
    float distance = uintBitsToFloat(hits[index].x);
    photons[places[index]] = Photon(p.position_ws + (distance - p.path_length) * p.direction_ws, p.source, p.axis_u,
                                    LEG_DIRECT | p.light << LEG_LIGHT_SHIFT, p.axis_v, distance, arrived_flux(p),
                                    hits[index].y, 0.0, 0.0, 0.0, 0.0);
}
