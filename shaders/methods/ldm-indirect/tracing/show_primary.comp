// Primary photons that saw a surface, as glyphs.
layout(local_size_x = 64) in;
#include "methods/ldm-indirect/tracing/primary.glsl"

layout(std430) readonly buffer Primaries { Primary primaries[]; };
#ifdef PACK
// Words of an element: centre, axis_u, axis_v, normal, direction, flux (3 each), luminance, path_length, light,
// source.
layout(std430) writeonly buffer AllShown { uint shown[]; };
layout(std430) readonly buffer Places { uint places[]; };
#else
layout(std430) writeonly buffer Counts { uint counts[]; };
#endif

uniform uint first_item, end_item, capacity;

#ifdef PACK
const uint WORDS = 22u;

void put(uint word, vec3 v) {
    for (uint i = 0u; i < 3u; ++i) shown[word + i] = floatBitsToUint(v[i]);
}
#endif

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index >= end_item) return;
    Primary p = primaries[index];
    bool is_shown = p.fate == PRIMARY_SPLITS;
#ifndef PACK
    counts[index] = is_shown ? 1u : 0u;
#else
    if (!is_shown || places[index] >= capacity) return;
    uint word = WORDS * places[index];
    vec3 flux = arrived_flux(p);
    put(word, p.position_ws);
    put(word + 3u, p.axis_u);
    put(word + 6u, p.axis_v);
    put(word + 9u, p.shading_ws);
    put(word + 12u, p.direction_ws);
    put(word + 15u, flux);
    shown[word + 18u] = floatBitsToUint(dot(flux, vec3(0.2126, 0.7152, 0.0722)));
    shown[word + 19u] = floatBitsToUint(p.path_length);
    shown[word + 20u] = p.light;
    shown[word + 21u] = p.source;
#endif
}
