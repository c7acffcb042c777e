// What rays from lights hit: whether a photon survives there, or the sample points themselves. Points before the
// first traced one are those of the maps.
layout(local_size_x = 64) in;
#include "lib/light.glsl"
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/survival.glsl"
#include "methods/photon-mapping/emission/emission_set.glsl"
#include "methods/photon-mapping/emission/emitted.glsl"
#include "methods/photon-mapping/emission/seeds.glsl"
#include "passes/raytracing/rays.glsl"
#include "passes/scene/hit_surface.glsl"

layout(std430) readonly buffer Rays { Ray rays[]; };
layout(std430) readonly buffer Hits { RayHit hits[]; };
layout(std430) readonly buffer Emitted { EmittedRay emitted[]; };
#if PACKS
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Samples { SamplePoint samples[]; };
uniform uint capacity;
uniform float power_unit, photons_per_point;
#else
layout(std430) writeonly buffer Survivors { uint survivors[]; };
#endif

uniform uint first_item, end_item;      // of the rays
uniform uint first_traced;              // point of the frame that the first ray is for
uniform int materials_model;            // one of survival.glsl's
uniform bool follows_mirrors;
uniform float photon_near, photon_far;  // m; 0 as far plane: none
uniform int normal_maps;

bool is_met_again(HitSurface s) {
    return is_met_again(1.0 - s.transmission * (1.0 - s.metallic), s.metallic, s.roughness, materials_model,
                        follows_mirrors);
}

/// Probability of the roulette before a photon leaves.
float survival_at(HitSurface s) {
    if (s.is_unlit) return 0.0;
    if (is_met_again(s)) return 1.0;  // the roulette is that of the scattering
    return survival_probability(first_reflectance(s.base_colour, s.metallic, s.ior, materials_model));
}

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    Ray ray = rays[item];
    RayHit hit = hits[item];
    uint point_number = first_traced + item;
    float survival = 0.0, part = 0.0;
    HitSurface s;
    if (ray.far > 0.0 && is_hit(hit)) {
        s = hit_surface(hit.triangle, hit.u, hit.v, ray.direction_ws, normal_maps != 0);
        part = range_window(emitted[item].range, hit.distance);
        bool between = hit.distance >= photon_near && (photon_far <= 0.0 || hit.distance <= photon_far);
        if (between && part > 0.0) survival = survival_at(s);
    }
    bool survives = roulette_of_item(point_number) < survival;
#if PACKS
    uint place = places[point_number];
    if (!survives || place >= capacity) return;
    SamplePoint point;
    point.position_ws = is_met_again(s) ? ray.origin_ws : s.position_ws;
    point.power = packed_power(emitted[item].power * (part / (survival * photons_per_point * power_unit)));
    point.normal = packed_direction(s.shading_normal_ws);
    point.geometric_normal = packed_direction(s.geometric_normal_ws);
    point.arrived_from = packed_direction(-ray.direction_ws);
    point.seed = seed_of_item(point_number);
    point.surface = packUnorm4x8(vec4(s.base_colour, s.roughness));
    point.light = packed_light(emitted[item].light, s.metallic) | (is_met_again(s) ? LEAVES_ALONG_RAY : 0u) |
                  (emitted[item].has_extent != 0u ? HAS_LIGHT_SAMPLES : 0u);
    point.ior = s.ior;
    point.origin = NO_TEXEL;
    samples[place] = point;
#else
    survivors[point_number] = survives ? 1u : 0u;
#endif
}
