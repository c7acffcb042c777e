// Packs the points that survive into "photons.samples", in the order of their seeds.
layout(local_size_x = 64) in;
#define PROBABILITY_MAP 3
#define HAAR_PYRAMID 4
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/emission/rsm.glsl"
#include "methods/photon-mapping/emission/maps.glsl"

layout(std430) readonly buffer Sources { Source sources[]; };
layout(std430) readonly buffer Candidates { uint candidates[]; };
layout(std430) readonly buffer Places { uint places[]; };
layout(std430) writeonly buffer Samples { SamplePoint samples[]; };
#include "methods/photon-mapping/emission/sources.glsl"

uniform uint first_item, end_item, capacity;
uniform float power_unit, photons_per_point;

/// Power that a point stands for before the surface, W, estimated exactly: what goes through the texel over
/// the expected number of points there.
/// DEVIATION [Smal19 §5.3.3]: printed is (P0/P)(pi/4) of the uniform power, which takes all texels for equal in
/// flux and turns pi/4 upside down: a cone in a square map keeps 0.617 of its flux.
vec3 power_of(Source source, RsmTexel t, ivec2 texel, int layer) {
    float points = float(source.points);
    int resolution = textureSize(probability_map, 0).x, levels = findMSB(resolution);
    float texels = float(resolution * resolution);
#if WARPS
    float probability = texelFetch(probability_map, ivec3(texel, layer), 0).r;
    float mean = mean_probability(layer, levels);
    if (probability <= 0.0) return vec3(0);
#if PRINTED_POWER
    float channels = max((source.intensity.r + source.intensity.g + source.intensity.b) / 3.0, 1e-30);
    vec3 uniform_power = source.intensity / channels * (source.flux / points);
    return (mean / probability) * 0.78539816 * uniform_power;
#endif
    float normalised = probability / (mean * texels);
#else
    float normalised = 1.0 / texels;
#endif
    return source.intensity * (t.part * t.extent / (points * normalised));
}

/// Where in its texel the point came to.
vec2 within_texel(uint item, int layer) {
    vec2 point = emission_point(emission_set_of(uint(layer)), item - sources[layer].first_point);
    int resolution = textureSize(probability_map, 0).x;
#if WARPS
    return warped_to_texel(point, layer, findMSB(resolution)).within;
#else
    return unwarped_texel(point, resolution).within;
#endif
}

/// Towards the light.
vec3 arrived_from(vec3 position_ws, Source source) {
    return source.perspective > 0.0 ? normalize(source.origin_ws - position_ws) : -source.direction_ws;
}

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    if (item >= end_item) return;
    uint candidate = candidates[item];
    uint place = places[item];
    if ((candidate & CANDIDATE_SURVIVES) == 0u || place >= capacity) return;
    uint layer = candidate >> 20u & 63u;
    uvec2 texel = uvec2(candidate & 1023u, candidate >> 10u & 1023u);
    RsmTexel t = rsm_texel(ivec2(texel), int(layer));
    // the reflectance itself is the first scattering's
    vec3 power = power_of(sources[layer], t, ivec2(texel), int(layer)) / (rsm_survival(t) * photons_per_point);

    SamplePoint point;
    vec2 within = within_texel(item, int(layer));
    RsmRay ray = rsm_ray(vec2(texel) + within, shadow_views[layer]);
    point.position_ws = t.is_met_again ? ray.origin_ws + shadow_views[layer].near * ray.direction_ws
                                       : jittered_position(t, within, ivec2(texel), int(layer));
    point.power = packed_power(power / power_unit);
    point.normal = packed_direction(t.normal_ws);
    point.geometric_normal = packed_direction(t.geometric_normal_ws);
    point.arrived_from = packed_direction(t.is_met_again ? -normalize(ray.direction_ws)
                                                         : arrived_from(point.position_ws, sources[layer]));
    point.seed = seed_of_item(item);
    point.surface = packUnorm4x8(vec4(t.base_colour, t.roughness));
    point.light = packed_light(sources[layer].light, t.metalness) | (t.is_met_again ? LEAVES_ALONG_RAY : 0u);
    point.ior = t.ior;
    point.origin = texel.x | texel.y << 10u | layer << 20u;
    samples[place] = point;
}
