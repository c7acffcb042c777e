// Points compete for the samples that they cover: first their depths, then, at the nearest depth, the last
// of them. Rasterising points would do the same, but on software drivers many times slower.
#include "passes/viewers/layer.glsl"
#include "passes/viewers/project.glsl"
#include "passes/viewers/points.glsl"

layout(local_size_x = 256) in;

uniform uint elements_per_invocation;
uniform bool name_elements;  // the second time

void claim(ivec2 sample_px, uint key, uint element) {
    uint at = uint(sample_px.y) * uint(size_px.x) + uint(sample_px.x);
    if (name_elements) {
        if (nearest_keys[at] == key) atomicMax(nearest_elements[at], element + 1u);
    } else if (nearest_keys[at] < key) {
        atomicMax(nearest_keys[at], key);
    }
}

void main() {
    uint first = gl_WorkGroupID.x * gl_WorkGroupSize.x * elements_per_invocation + gl_LocalInvocationIndex;
    float radius = point_radius();
    for (uint k = 0u; k < elements_per_invocation; ++k) {
        uint i = first + k * gl_WorkGroupSize.x;
        if (i >= layer.drawn) break;
        uint element = i * layer.step, base = element_base(element);
        vec3 position_ws = vector_at(base, layer.place[0]);
        vec2 centre_px;
        float depth;
        if (!is_finite(position_ws) || !passes_filters(base) || !point_place(position_ws, centre_px, depth)) continue;
        // samples whose middles lie in the point's square; far outside, nothing overflows
        vec2 low = clamp(ceil(centre_px - radius - 0.5), vec2(0), size_px);
        vec2 high = clamp(ceil(centre_px + radius - 0.5), vec2(0), size_px);
        uint key = ~floatBitsToUint(depth);
        for (int y = int(low.y); y < int(high.y); ++y)
            for (int x = int(low.x); x < int(high.x); ++x)
                if (!is_round() || distance(vec2(x, y) + 0.5, centre_px) <= radius) claim(ivec2(x, y), key, element);
    }
}
