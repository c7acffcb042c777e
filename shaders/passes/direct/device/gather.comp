// Adds what the rays of a sample brought to the pixels of a band, or to what their rays met (HITS). PANES: rays that
// met a sheet of clear glass go on behind it, weakened: passes::Panes (renderers/passes/direct/panes.h).
layout(local_size_x = 64) in;

#include "lib/floats.glsl"
#include "passes/direct/device/samples.glsl"
#include "passes/lights/light_pdfs.glsl"
#include "passes/raytracing/rays.glsl"
#if defined(HITS) || defined(PANES)
#include "passes/direct/device/hit_scatterer.glsl"
#endif
#ifndef HITS
#include "passes/direct/device/seen_surface.glsl"
#endif

#ifdef PANES
layout(std430) buffer Rays { Ray rays[]; };
layout(std430) buffer LightPaths { LightPath light_paths[]; };
uniform bool may_pass;  // what a ray meets; else even a pane ends it
#else
layout(std430) readonly buffer Rays { Ray rays[]; };
layout(std430) readonly buffer LightPaths { LightPath light_paths[]; };
#endif
layout(std430) readonly buffer Hits { RayHit hits[]; };
layout(std430) buffer GroupLight { vec4 group_light[]; };
/// Of each triangle of the world which emissive one it is, or 0xffffffff.
layout(std430) readonly buffer EmissiveNumbers { uint emissive_numbers[]; };

/// Weighted against having been chosen among the sources.
vec3 weighted(LightPath path, vec3 radiance, float pdf) {
    float part = path.pdf > 0.0 ? power_heuristic(path.pdf, pdf) : 1.0;
    return path.weight * radiance * part;
}

/// Lamps, which stop no ray, in front of what it met.
vec3 met_lamps(LightPath path, Ray ray, float end, vec3 origin_ws, vec3 n) {
    SourceTotals sources = source_totals[0];
    vec3 sum = vec3(0);
    for (uint i = 0u; i < sources.lamps; ++i)
        if (lamp_distance(lamps[i], ray.origin_ws, ray.direction_ws) < end)
            sum += weighted(path, lamps[i].radiance,
                            pdf_of_lamp(sources, origin_ws, n, lamps[i], ray.direction_ws));
    return sum;
}

uint emissive_number(RayHit hit) {
    return source_totals[0].triangles > 0u ? emissive_numbers[hit.triangle] : 0xffffffffu;
}

/// What a ray ends at.
vec3 met_at_end(LightPath path, Ray ray, RayHit hit, vec3 origin_ws, vec3 n) {
    SourceTotals sources = source_totals[0];
    if (!is_hit(hit)) {
        if (!has_environment(sources)) return vec3(0);
        return weighted(path, environment_radiance(sources, ray.direction_ws),
                        pdf_of_environment(sources, n, ray.direction_ws));
    }
    uint number = emissive_number(hit);
    if (number == 0xffffffffu) return vec3(0);
    EmissiveTriangle t = emissive_triangles[number];
    vec3 emission = emission_at(t, vec2(hit.u, hit.v));
    if (emission == vec3(0)) return emission;
    return weighted(path, emission, pdf_of_triangle(sources, origin_ws, n, t, vec2(hit.u, hit.v)));
}

#ifdef PANES
/// Fraction that passes straight on; 0 where it is no pane, or the source itself.
vec3 passed_by(RayHit hit, HitSurface s, vec3 direction_ws) {
    uint number = emissive_number(hit);
    if (number != 0xffffffffu && emission_at(emissive_triangles[number], vec2(hit.u, hit.v)) != vec3(0)) return vec3(0);
    SeenSurface pane = scatterer_of(s, direction_ws);
    return pane.exists ? passed_straight(pane.scatterer, pane.glass, pane.wo) : vec3(0);
}

/// Whether the ray goes on behind a pane.
bool goes_on(uint index, Ray ray, RayHit hit) {
    if (!may_pass || !is_hit(hit)) return false;
    HitSurface s = hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, false);
    vec3 passed = passed_by(hit, s, ray.direction_ws);
    if (passed == vec3(0)) return false;
    light_paths[index].weight *= passed;
    vec3 origin_ws = offset_origin(s.position_ws, -s.geometric_normal_ws);
    rays[index] = Ray(origin_ws, ray.far - hit.distance, ray.direction_ws, 0.0);
    return true;
}
#else
bool goes_on(uint index, Ray ray, RayHit hit) { return false; }
#endif

void end_ray(uint index) {
#ifdef PANES
    rays[index] = no_ray();
#endif
}

vec3 of_source(uint index) {
    Ray ray = rays[index];
    if (!(ray.far > 0.0)) return vec3(0);
    RayHit hit = hits[index];
    if (goes_on(index, ray, hit)) return vec3(0);
    vec3 light = is_hit(hit) ? vec3(0) : light_paths[index].weight;
    end_ray(index);
    return light;
}

vec3 of_direction(uint index, vec3 origin_ws, vec3 n) {
    Ray ray = rays[index];
    if (!(ray.far > 0.0)) return vec3(0);
    RayHit hit = hits[index];
    LightPath path = light_paths[index];
    vec3 light = met_lamps(path, ray, hit.distance, origin_ws, n);
    if (goes_on(index, ray, hit)) return light;
    light += met_at_end(path, ray, hit, origin_ws, n);
    end_ray(index);
    return light;
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    ivec2 pixel;
    if (!pixel_of(place, pixel)) return;
#ifdef HITS
    SeenSurface surface = surface_of_hit(rays[ray_of_hit(place)], hits[ray_of_hit(place)], 0.0, false);
#else
    SeenSurface surface = seen_surface(pixel);
#endif
    if (!surface.exists) return;
    vec3 origin_ws = offset_origin(surface.position_ws, surface.geometric_n);
    vec3 light = of_source(place) + of_direction(direction_ray(place), origin_ws, surface.geometric_n);
    if (is_finite(light)) group_light[place].rgb += light;
}
