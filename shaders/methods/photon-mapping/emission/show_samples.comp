// Writes the points of emission sets at the steps of warping that are shown.  [Smal19 fig. 5.6]
layout(local_size_x = 64) in;
#include "lib/floats.glsl"
#include "methods/photon-mapping/emission/steps.glsl"

// C++: ir::methods::photon_mapping::ShownSample
struct ShownSample {
    float place[3];
    uint source, warp, point, survives;
    float probability;
};
layout(std430) writeonly buffer Shown { ShownSample shown[]; };
layout(std430) buffer ShownCount { uint shown_count; };

uniform uint stride, capacity;

const float GAP = 1.125;  // from square to square, where several are shown

void write(uint element, vec3 place, ShownPoint s, int step, float probability) {
    if (element < capacity)
        shown[element] = ShownSample(floats(place), s.source, uint(step), s.index, s.survives ? 1u : 0u, probability);
}

/// Levels side by side, vertical steps below horizontal ones, maps below each other.
vec3 laid_out(vec2 place, ShownPoint s, int step) {
    vec2 corner = vec2(0);
    if (step_count > 1) corner += GAP * vec2(float((step + 1) / 2), step > 0 && (step & 1) == 0 ? -1.0 : 0.0);
    if (shown_source < 0) corner.y -= (step_count > 1 ? 2.25 : 1.0) * GAP * float(s.source);
    return vec3(corner + vec2(place.x, 1.0 - place.y), 0.0);
}

void main() {
    uint item = first_item + gl_GlobalInvocationID.x;
    ShownPoint s = shown_point(item);
    uint number = shown_source < 0 ? item : s.index;
    if (!s.is_shown || number % stride != 0u) return;
    uint first = number / stride * uint(step_count);
    atomicAdd(shown_count, uint(step_count));
    float probability = 0.0;
    if (source_count > 0u) {
        uint texel = candidates[item];
        probability = texelFetch(probability_map, ivec3(texel & 1023u, texel >> 10u & 1023u, s.source), 0).r;
    }
    for (int step = 0; step < first_step + step_count; ++step) {
        take_step(s, step);
        if (step < first_step) continue;
        write(first + uint(step - first_step), laid_out(place_of(s.warped, step), s, step), s, step, probability);
    }
}
