// Packed arrays, first step: one invocation counts the different depths of one texel. Those that are equal once
// packed answer every question alike, and one of them is kept.
layout(local_size_x = 128) in;
#include "passes/ldm/packed_builder.glsl"

layout(std430) buffer Merged { uint merged; };

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel >= row_count * resolution) return;
    uint begin = counts[texel], end = counts[texel + 1u], count = end - begin;
    // Without room for the sorted depths as many as there may be are asked for.
    if (has_sorted(texel)) {
        uint last = 0xffffffffu;
        count = 0u;
        for (uint i = begin; i < end; ++i) {
            uint bits = sorted_at(i);
            if (bits != last) ++count;
            last = bits;
        }
        if (count < end - begin) atomicAdd(merged, end - begin - count);
    }
    packed_texels[texel] = count;
}
