// What looks at the scene from the interfaces of a band's pixels: Reflections of
// renderers/methods/ldm-indirect/gloss/gloss_on_host.cpp.
#include "lib/point_sequence.glsl"
#include "passes/direct/device/samples.glsl"
#include "passes/raytracing/rays.glsl"

/// Where it goes is among the rays of hits.
// C++: ir::methods::ldm_indirect::GlossPath
struct Path {
    vec3 throughput;
    uint scatterings;  // of the light on its way to the eye; mirrors are none
    vec3 light;        // W/(m² sr), of what it has met
    float unused;
};

uniform uint seed_low, seed_high;  // of the frame
uniform uint number;               // of the pixel's samples
uniform float share;               // a direction drawn with density p stands for share / p sr
uniform bool is_whole;             // direct light that mirrors show counts

/// Of the event's direction.
Scattered scattered_at(Scatterer s, Glass glass, vec3 wo, ivec2 pixel, uint event) {
    uvec2 key = pixel_key(uvec2(seed_low, seed_high), uvec2(pixel));
    float lobe = path_pair(key, number, 2u * event).x;
    return scatter(s, glass, wo, lobe, path_pair(key, number, 2u * event + 1u), MICROFACETS_VISIBLE_NORMALS);
}

/// What the ray stands for of the directions that its surface may send it to, sr.
float spread_of(Scattered scattered, Scatterer s, Glass glass, vec3 wo) {
    if (scattered.is_specular || share == 0.0) return 0.0;
    float pdf = evaluate_with_pdf(s, glass, seen_from(s, wo), scattered.direction_ws).pdf;
    return pdf > 0.0 ? share / pdf : 0.0;
}

/// As Spreads of hit_scatterer.glsl says it. A mirror is no scattering: what it shows of a source to a surface that is
/// seen is direct light.
float signed_spread(Path path, float spread) { return is_whole || path.scatterings > 1u ? spread : -spread; }

/// None where it goes below the surface.
Ray ray_from(vec3 position_ws, vec3 geometric_n, vec3 direction_ws) {
    if (dot(direction_ws, geometric_n) <= 0.0) return no_ray();
    return Ray(offset_origin(position_ws, geometric_n), RAY_INFINITY, direction_ws, 0.0);
}
