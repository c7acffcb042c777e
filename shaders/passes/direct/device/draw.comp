// Draws the rays of one sample of each pixel of a band, or of the surface that its ray met (HITS):
// passes::LightEstimate (renderers/passes/direct/light_estimate.h).
layout(local_size_x = 64) in;

#include "lib/floats.glsl"
#include "passes/direct/device/samples.glsl"
#include "passes/lights/light_sampler.glsl"
#include "passes/raytracing/rays.glsl"
#ifdef HITS
#include "passes/direct/device/hit_scatterer.glsl"
#else
#include "passes/direct/device/seen_surface.glsl"
#endif

#ifdef HITS
layout(std430) buffer Rays { Ray rays[]; };
layout(std430) readonly buffer Hits { RayHit hits[]; };
#else
layout(std430) writeonly buffer Rays { Ray rays[]; };
#endif
layout(std430) writeonly buffer LightPaths { LightPath light_paths[]; };

uniform uint seed_low, seed_high;  // of the frame
uniform uint group, number;  // which of the pixel's independent randomisations, and of its samples
uniform bool mirrors;     // show the sources that they reflect
uniform bool any_hit;     // nothing lets light through

// Pairs of numbers of a sample.
const uint OF_CHOICES = 0u, OF_SOURCE = 1u, OF_DIRECTION = 2u;

Ray towards_source(SeenSurface surface, SeenScatterer seen, vec3 origin_ws, float choice, vec2 u, out vec3 radiance) {
    radiance = vec3(0);
    LightSample light = sample_source(source_totals[0], origin_ws, surface.geometric_n, choice, u);
    // rough glass lets nothing through
    if (!(light.pdf > 0.0) || dot(surface.geometric_n, light.direction_ws) <= 0.0) return no_ray();
    BsdfValue scattered = evaluate_with_pdf(surface.scatterer, surface.glass, seen, light.direction_ws);
    radiance = scattered.value * light.radiance * (power_heuristic(light.pdf, scattered.pdf) / light.pdf);
    if (radiance == vec3(0) || !is_finite(radiance)) return no_ray();
    return Ray(origin_ws, light.distance * SHADOW_RAY_END, light.direction_ws, any_hit ? 1.0 : 0.0);
}

Ray by_direction(SeenSurface surface, SeenScatterer seen, vec3 origin_ws, float lobe, vec2 u, out LightPath path) {
    path = LightPath(vec3(0), 0.0);
    ChosenDirection chosen = choose_direction(surface.scatterer, surface.glass, seen, lobe, u);
    if (!chosen.exists || (chosen.is_specular && !mirrors)) return no_ray();
    // Most directions meet no source, and need neither weight nor ray.
    if (!may_meet(source_totals[0], origin_ws, chosen.wi)) return no_ray();
    path.weight = chosen.weight;
    if (!chosen.is_specular) {
        BsdfValue scattered = evaluate_with_pdf(surface.scatterer, surface.glass, seen, chosen.wi);
        if (!(scattered.pdf > 0.0)) return no_ray();
        path = LightPath(scattered.value / scattered.pdf, scattered.pdf);
    }
    if (path.weight == vec3(0) || !is_finite(path.weight)) return no_ray();
    return Ray(origin_ws, RAY_INFINITY, chosen.wi, 0.0);
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (!pixel_of(place, pixel)) return;
    Ray source_ray = no_ray(), drawn_ray = no_ray();
    LightPath drawn = LightPath(vec3(0), 0.0);
    vec3 radiance = vec3(0);
#ifdef HITS
    SeenSurface surface = surface_of_hit(rays[ray_of_hit(place)], hits[ray_of_hit(place)], spreads[place], true);
#else
    SeenSurface surface = seen_surface(pixel);
#endif
    if (surface.exists) {
        vec3 origin_ws = offset_origin(surface.position_ws, surface.geometric_n);
        SeenScatterer seen = seen_from(surface.scatterer, surface.wo);
        // Each frame and group has numbers of its own; within a group samples are stratified.
        uvec2 key = sum64(pixel_key(uvec2(seed_low, seed_high), uvec2(pixel)), uvec2(group, 0u));
        vec2 choices = path_pair(key, number, OF_CHOICES);
        if (has_smooth_part(surface.scatterer, surface.glass))
            source_ray =
                towards_source(surface, seen, origin_ws, choices.x, path_pair(key, number, OF_SOURCE), radiance);
        drawn_ray = by_direction(surface, seen, origin_ws, choices.y, path_pair(key, number, OF_DIRECTION), drawn);
    }
    rays[place] = source_ray;
    light_paths[place] = LightPath(radiance, 0.0);
    rays[direction_ray(place)] = drawn_ray;
    light_paths[direction_ray(place)] = drawn;
}
