// What the programs share that sample the direct light of sources with an extent. They go over a band of pixels, one
// sample of each at a time. Each sample has two rays: towards a source, and along a direction drawn from the material.
// MATERIALS: as Transport::Materials counts.
#include "lib/bsdf.glsl"
#include "lib/material.glsl"
#include "passes/raytracing/ray_offset.glsl"

layout(std430) readonly buffer Materials { Material materials[]; };

uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
uniform sampler2D gbuffer_albedo;
uniform sampler2D gbuffer_material;

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

/// A pixel's surface.
struct SeenSurface {
    bool exists;  // and is lit
    vec3 position_ws, geometric_n;
    Scatterer scatterer;
    Glass glass;
};

/// frame_around() is discontinuous at n.z = 0, where on the host −0 counts as negative.
vec3 with_sign_of_zero(vec3 n) { return floatBitsToUint(n.z) == 0x80000000u ? vec3(n.xy, -1e-30) : n; }

SeenSurface seen_surface(ivec2 pixel) {
    SeenSurface seen;
    vec4 position = texelFetch(gbuffer_position, pixel, 0), material = texelFetch(gbuffer_material, pixel, 0);
    seen.exists = position.w != 0.0 && material.z <= 0.5;
    if (!seen.exists) return seen;
    vec4 albedo = texelFetch(gbuffer_albedo, pixel, 0);
    vec3 normal = texelFetch(gbuffer_normal, pixel, 0).xyz;
    seen.position_ws = position.xyz;
    seen.geometric_n = with_sign_of_zero(normalize(texelFetch(gbuffer_geometric_normal, pixel, 0).xyz));
    float size = length(normal);  // half floats: not quite 1
    vec3 n = size > 0.5 ? with_sign_of_zero(normal / size) : seen.geometric_n;
    // a half float, which is exact only up to 2048
    Material m = materials[uint(clamp(material.w + 0.5, 0.0, float(materials.length() - 1)))];
    seen.scatterer = make_scatterer(n, seen.geometric_n, albedo.rgb, material.x, material.y, m.ior, MATERIALS);
    seen.glass = NO_GLASS;
    if (MATERIALS != SCATTERING_LAMBERT)
        seen.glass = make_glass(albedo.a * (1.0 - material.x), m.ior, m.thickness, albedo.rgb, true);
    return seen;
}

/// Of a sample that was drawn with density `pdf` where another technique has the density `other`.
/// [Veach95, power heuristic with β = 2]
float power_heuristic(float pdf, float other) {
    float ratio = other / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}
