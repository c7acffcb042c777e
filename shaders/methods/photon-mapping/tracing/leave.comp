// The first scattering, of the light that arrived at the sample points; before mirrors and glass its way there.
layout(local_size_x = 64) in;

#define TALLIES
#include "methods/photon-mapping/tracing/path.glsl"
#include "methods/photon-mapping/tracing/tally.glsl"

layout(std430) readonly buffer Samples { SamplePoint samples[]; };
layout(std430) readonly buffer SampleCount { uint sample_count; };

uniform uint repeats;          // photons that leave a sample point
uniform uint sample_capacity;

Path path_from(SamplePoint point, uint repeat) {
    vec3 power = unpacked_power(point.power);
    uint sampled = (point.light & HAS_LIGHT_SAMPLES) != 0u ? IS_SAMPLED : 0u;
    return Path(floats(power), 0.0, light_of(point) << 8u | sampled | repeat << 16u, point.seed, NO_MEDIUM);
}

Ray leave(uint index) {
    uint number = index / repeats;
    if (number >= min(sample_count, sample_capacity)) return no_ray();
    SamplePoint point = samples[number];
    vec4 surface = unpackUnorm4x8(point.surface);
    vec3 n = unpacked_direction(point.normal), geometric_n = unpacked_direction(point.geometric_normal);
    vec3 arrived_from = unpacked_direction(point.arrived_from);
    Path path = path_from(point, index % repeats);
    count(0u, TALLY_RAYS);
    count_power(0u, power_of(path));
    if ((point.light & LEAVES_ALONG_RAY) != 0u) {
        paths[index] = path;
        return Ray(point.position_ws, RAY_INFINITY, -arrived_from, 0.0);
    }

    Scatterer scatterer =
        make_scatterer(n, geometric_n, surface.rgb, metalness_of(point), surface.a, point.ior, materials);
    uvec4 words = random_words(path, 0u, DIRECTION);
    Scattered scattered =
        scatter_photon(scatterer, arrived_from, unit_float(words.x), unit_float(words.yz), microfacet_sampling);
    // the roulette at the sample point divided the power by its probability already
    float passed = survival_probability(first_reflectance(surface.rgb, metalness_of(point), point.ior, materials));
    if (!scatter_path(path, scattered, power_of(path) * passed, 0u, unit_float(words.w))) {
        count(0u, TALLY_ABSORBED);
        return no_ray();
    }
    paths[index] = path;
    vec3 origin_ws = point.position_ws + ray_offset(point.position_ws) * geometric_n;
    return Ray(origin_ws, far_of(path), scattered.direction_ws, 0.0);
}

void main() {
    begin_tally();
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index < end_item) rays[index] = leave(index);
    end_tally();
}
