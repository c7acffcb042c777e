// The first scattering: of the light that arrived at the sample points.
layout(local_size_x = 64) in;

#define TALLIES
#include "methods/photon-mapping/tracing/path.glsl"
#include "methods/photon-mapping/tracing/tally.glsl"

layout(std430) readonly buffer Samples { SamplePoint samples[]; };
layout(std430) readonly buffer Sources { Source sources[]; };
layout(std430) readonly buffer SampleCount { uint sample_count; };

uniform uint repeats;          // photons that leave a sample point
uniform uint sample_capacity;

/// Towards the light.
vec3 arrived_from(SamplePoint point, Source source) {
    return source.perspective > 0.0 ? normalize(source.origin_ws - point.position_ws) : -source.direction_ws;
}

Path path_from(SamplePoint point, Source source, uint repeat) {
    vec3 power = unpacked_power(point.power);
    return Path(floats(power), 0.0, (source.light & 63u) << 8u | repeat << 16u, point.seed);
}

Ray leave(uint index) {
    uint number = index / repeats;
    if (number >= min(sample_count, sample_capacity)) return no_ray();
    SamplePoint point = samples[number];
    Source source = sources[source_of(point)];
    vec4 surface = unpackUnorm4x8(point.surface);
    vec3 n = unpacked_direction(point.normal);
    Path path = path_from(point, source, index % repeats);
    count(0u, TALLY_RAYS);
    count_power(0u, power_of(path));

    // DEVIATION [own]: sample points have no geometric normal and no index of refraction; the shading normal
    // and 1.5 take their place. Rays into the surface are found when they land.
    Scatterer scatterer = make_scatterer(n, n, surface.rgb, metalness_of(point), surface.a, 1.5, materials);
    uvec4 words = random_words(path, 0u, DIRECTION);
    Scattered scattered = scatter(scatterer, arrived_from(point, source), unit_float(words.x),
                                  unit_float(words.yz), microfacet_sampling);
    // the roulette at the sample point divided the power by its probability already
    float passed =
        survival_probability(first_reflectance(surface.rgb, metalness_of(point), surface.a, materials));
    if (!scatter_path(path, scattered, power_of(path) * passed, 0u, unit_float(words.w))) {
        count(0u, TALLY_ABSORBED);
        return no_ray();
    }
    paths[index] = path;
    vec3 origin_ws = point.position_ws + offset_of_rays(point.position_ws) * n;
    return Ray(origin_ws, far_of(path), scattered.direction_ws, 0.0);
}

void main() {
    begin_tally();
    uint index = first_item + gl_GlobalInvocationID.x;
    if (index < end_item) rays[index] = leave(index);
    end_tally();
}
