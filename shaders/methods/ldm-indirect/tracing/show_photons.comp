// Stored photons as glyphs, with their legs told apart.
layout(local_size_x = 64) in;
#include "lib/spaces.glsl"
#include "methods/ldm-indirect/records.glsl"

layout(std430) readonly buffer Photons { Photon photons[]; };
layout(std430) readonly buffer StoredCount { uint stored_count; };
// Words of an element: centre, axis_u, axis_v, normal, flux (3 each), luminance, path_length, map, side, light,
// direct, source.
layout(std430) writeonly buffer AllShown { uint shown[]; };
layout(std430) buffer ShownCount { uint shown_count; };

uniform uint first_item, end_item, capacity, shown_capacity;
const uint WORDS = 22u;

void put(uint word, vec3 v) {
    for (uint i = 0u; i < 3u; ++i) shown[word + i] = floatBitsToUint(v[i]);
}

void main() {
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index == 0u) shown_count = stored_count;
    if (index >= min(end_item, min(stored_count, capacity)) || index >= shown_capacity) return;
    Photon p = photons[index];
    uint word = WORDS * index;
    put(word, p.centre_ws);
    put(word + 3u, p.axis_u);
    put(word + 6u, p.axis_v);
    put(word + 9u, unpacked_direction(p.normal));
    put(word + 12u, p.flux);
    shown[word + 15u] = floatBitsToUint(dot(p.flux, vec3(0.2126, 0.7152, 0.0722)));
    shown[word + 16u] = floatBitsToUint(p.path_length);
    shown[word + 17u] = p.leg & LEG_MAP;
    shown[word + 18u] = uint((p.leg & LEG_ALONG) != 0u ? 1 : -1);
    shown[word + 19u] = p.leg >> LEG_LIGHT_SHIFT;
    shown[word + 20u] = uint((p.leg & LEG_DIRECT) != 0u);
    shown[word + 21u] = p.source;
}
