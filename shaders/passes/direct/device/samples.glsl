// What the programs share that sample direct light (renderers/passes/direct/device/light_rays.h). They go over a band
// of pixels, one sample of each at a time. Each sample has two rays: towards a source, and along a direction drawn from
// the material. MATERIALS: as Transport::Materials counts. HITS: the surfaces are those that further rays met, in place
// of the pixels'.
#include "lib/bsdf.glsl"
#include "lib/material.glsl"
#include "passes/raytracing/ray_offset.glsl"

uniform uint first_pixel, end_pixel;  // of the band, row by row
uniform int width;
uniform uint rays_of_kind;  // of either kind there is room for so many

/// Of a ray. W/(m² sr), or a weight of what its direction's ray meets.
// C++: ir::passes::LightPathRecord
struct LightPath {
    vec3 weight;
    float pdf;  // with which the direction was drawn; 0: of a mirror. Not of rays towards sources
};

/// False beyond the band.
bool pixel_of(uint place, out ivec2 pixel) {
    uint index = first_pixel + place;
    pixel = ivec2(index % uint(width), index / uint(width));
    return index < end_pixel;
}
uint direction_ray(uint place) { return rays_of_kind + place; }
uint ray_of_hit(uint place) { return 2u * rays_of_kind + place; }

/// A surface that is sampled: of a pixel (seen_surface.glsl), or of what a ray met (hit_scatterer.glsl).
struct SeenSurface {
    bool exists;  // and is lit
    vec3 position_ws, geometric_n;
    vec3 wo;  // unit, to where it is seen from
    Scatterer scatterer;
    Glass glass;
};

/// frame_around() is discontinuous at n.z = 0, where on the host −0 counts as negative.
vec3 with_sign_of_zero(vec3 n) { return floatBitsToUint(n.z) == 0x80000000u ? vec3(n.xy, -1e-30) : n; }

/// Of a sample that was drawn with density `pdf` where another technique has the density `other`.
/// [Veach95, power heuristic with β = 2]
float power_heuristic(float pdf, float other) {
    float ratio = other / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}
