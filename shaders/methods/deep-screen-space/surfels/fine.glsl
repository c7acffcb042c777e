// A fine surfel, as transform feedback leaves it: 12 words.

#include "lib/constants.glsl"

layout(std430) readonly buffer FineSurfels { uvec4 fine_words[]; };

/// A surfel before thinning: 48 bytes, as transform feedback writes it.
// C++: ir::methods::deep_screen_space::FineSurfel
struct FineSurfel {
    vec3 centre_ws;
    uint triangle;
    vec3 normal_ws;
    float radius;  // m: π radius² is the patch's area over its number of surfels
    uint barycentrics, identity;  // as of Surfel
    uint patch_;  // index in "surfels.patches.list"
    float part;   // of the ideal area at its place
};

FineSurfel fine_surfel(uint index) {
    uvec4 a = fine_words[3u * index], b = fine_words[3u * index + 1u], c = fine_words[3u * index + 2u];
    return FineSurfel(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), c.x, c.y, c.z,
                      uintBitsToFloat(c.w));
}

float fine_area_of(FineSurfel s) { return PI * s.radius * s.radius; }
