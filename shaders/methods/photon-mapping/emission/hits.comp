// What rays from lights hit: whether a photon survives there, or the sample points themselves.
layout(local_size_x = 64) in;
#include "methods/photon-mapping/emission/light_rays.glsl"
#include "methods/photon-mapping/survival.glsl"
#include "passes/raytracing/rays.glsl"
#include "passes/scene/hit_surface.glsl"

layout(std430) readonly buffer Rays { Ray rays[]; };
layout(std430) readonly buffer Hits { RayHit hits[]; };
#if PACKS
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Samples { SamplePoint samples[]; };
uniform uint capacity;
uniform float power_unit, photons_per_point;
#else
layout(std430) writeonly buffer Survivors { uint survivors[]; };
#endif

uniform int materials_model;            // one of survival.glsl's
uniform float photon_near, photon_far;  // m; 0 as far plane: none
uniform int normal_maps;

/// Of the light's intensity that arrives: spot's profile and window at its range.
float part_of(Light light, Ray ray, float distance) {
    if (light.type == LIGHT_DIRECTIONAL) return 1.0;
    float profile = spot_fraction(light, dot(ray.direction_ws, light.direction_ws));
    return profile * range_window(light.range, distance);
}

/// Probability of the roulette before a photon leaves.
float survival_at(HitSurface s) {
    bool opaque = materials_model == SURVIVAL_LAMBERT || s.transmission <= 0.5;
    if (s.is_unlit || !opaque) return 0.0;
    return survival_probability(first_reflectance(s.base_colour, s.metallic, s.roughness, materials_model));
}

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint index = source_of_item(item);
    Source source = sources[index];
    Light light = lights[source.light];
    Ray ray = rays[item];
    RayHit hit = hits[item];
    float survival = 0.0, part = 0.0;
    HitSurface s;
    if (is_hit(hit)) {
        s = hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, normal_maps != 0);
        part = part_of(light, ray, hit.distance);
        bool between = hit.distance >= photon_near && (photon_far <= 0.0 || hit.distance <= photon_far);
        if (between && part > 0.0) survival = survival_at(s);
    }
    bool survives = roulette_of_item(item) < survival;
#if PACKS
    uint place = places[item];
    if (!survives || place >= capacity) return;
    vec3 power = source.intensity * (part * extent_of(light) / (float(source.points) * survival * photons_per_point));
    SamplePoint point;
    point.position_ws = s.position_ws;
    point.power = packed_power(power / power_unit);
    point.normal = packed_direction(s.shading_normal_ws);
    point.surface = packUnorm4x8(vec4(s.base_colour, s.roughness));
    point.origin = index << 20u | uint(round(clamp(s.metallic, 0.0, 1.0) * 63.0)) << 26u;
    point.seed = seed_of_item(item);
    samples[place] = point;
#else
    survivors[item] = survives ? 1u : 0u;
#endif
}
