// Primary photons that saw a surface, as glyphs.
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "lib/luminance.glsl"
#include "methods/ldm-indirect/tracing/primary.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
#ifdef PACK
// C++: ir::methods::ldm_indirect::ShownPrimary
struct ShownPrimary {
    float centre[3], axis_u[3], axis_v[3], normal[3], direction[3], flux[3];
    float luminance, path_length;
    uint light, source;
};
layout(std430) writeonly buffer AllShown { ShownPrimary shown[]; };
layout(std430) readonly buffer Places { uint places[]; };
#else
layout(std430) writeonly buffer Counts { uint counts[]; };
#endif

uniform uint first_item, end_item, capacity;

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index >= end_item) return;
    Primary p = primaries[index];
    bool is_shown = p.fate == PRIMARY_SPLITS;
#ifndef PACK
    counts[index] = is_shown ? 1u : 0u;
#else
    if (!is_shown || places[index] >= capacity) return;
    vec3 flux = arrived_flux(p);
    shown[places[index]] = ShownPrimary(floats(p.position_ws), floats(p.axis_u), floats(p.axis_v),
                                        floats(p.shading_ws), floats(p.direction_ws), floats(flux),
                                        luminance(flux), p.path_length, p.light, p.source);
#endif
}
