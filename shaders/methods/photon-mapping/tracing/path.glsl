// What the passes of tracing share: the state of a path, its random numbers and Russian roulette.

#include "lib/floats.glsl"
#include "lib/random.glsl"
#include "lib/scattering.glsl"
#include "methods/photon-mapping/records.glsl"
#include "methods/photon-mapping/survival.glsl"
#include "passes/raytracing/ray_offset.glsl"
#include "passes/raytracing/rays.glsl"

/// Between two surfaces. The ray is in the buffer of rays; one with far <= 0: the path has ended.
// C++: ir::methods::photon_mapping::PathState
struct Path {
    float power[3];  // in power units
    float distance;  // m since the last scattering, or since the first mirror or glass
    uint bits;       // 0-3 scatterings, 4-7 mirrors and clear glass, 8-13 light, 14 IS_SAMPLED, 16-31 repeat
    uint seed;
    uint medium;     // material that the ray is within, or NO_MEDIUM
};

const uint NO_MEDIUM = 0xffffffffu;
/// From a source with an extent, and at most through sheets of clear glass: light samples find it, too.
const uint IS_SAMPLED = 1u << 14u;

layout(std430) buffer Rays { Ray rays[]; };
layout(std430) buffer Paths { Path paths[]; };

uniform uint first_item, end_item;
uniform uint frame_seed;
uniform int materials;            // SCATTERING_…
uniform int microfacet_sampling;  // MICROFACETS_…
uniform bool per_channel;
uniform float max_distance;       // m between scatterings; 0: unlimited

uint scatterings_of(Path path) { return path.bits & 15u; }
uint mirrors_of(Path path) { return path.bits >> 4u & 15u; }
vec3 power_of(Path path) { return vec3(path.power[0], path.power[1], path.power[2]); }
void set_power(inout Path path, vec3 power) { path.power = floats(power); }

// Purposes of random words.
const uint DIRECTION = 0u, CHANNELS = 1u;

/// Of the path's seed and repeat, the surface and the purpose alone.
uvec4 random_words(Path path, uint surface, uint purpose) {
    return pcg4d(uvec4(path.seed, frame_seed, (path.bits & 0xffff0000u) | surface, purpose));
}

/// How far the path may go on; 0: nowhere.
float far_of(Path path) { return max_distance > 0.0 ? max_distance - path.distance : RAY_INFINITY; }

/// One survival probability for all channels; what leaves is divided by it. Weights beyond 1 are carried on.
/// [Smal19 eq. 4.9]
bool survives(inout vec3 power, vec3 arriving, float random) {
    float largest = max(arriving.r, max(arriving.g, arriving.b));
    float probability = largest > 0.0 ? survival_probability(power / largest) : 0.0;
    if (random >= probability) return false;
    power /= probability;
    return true;
}

/// Each channel survives by itself; what leaves has the power that arrived, or more, in those that did.
/// [Smal19 §4.4.2: changes the variance, not the mean]
bool channels_survive(inout vec3 power, vec3 arriving, vec3 random) {
    for (int i = 0; i < 3; ++i) {
        float probability = arriving[i] > 0.0 ? min(1.0, power[i] / arriving[i]) : 0.0;
        power[i] = random[i] < probability ? power[i] / probability : 0.0;
    }
    return power != vec3(0);
}

/// Scatters the path, whose power is set to what leaves. `arriving`: what the roulette measures survival by.
/// False where the photon is absorbed.
bool scatter_path(inout Path path, Scattered scattered, vec3 arriving, uint surface, float random) {
    vec3 power = power_of(path) * scattered.weight;
    if (power == vec3(0)) return false;
    bool goes_on = per_channel ? channels_survive(power, arriving,
                                                  unit_float(random_words(path, surface, CHANNELS).xyz))
                               : survives(power, arriving, random);
    set_power(path, power);
    if (scattered.is_specular) {
        path.bits += 16u;
    } else {
        path.bits += 1u;
        path.distance = 0.0;
    }
    return goes_on;
}
