// Depth peeling, a plane: the nearest fragment of each texel beyond the plane before, where those of equal depth come
// in order of arrival. One invocation: one fragment.
layout(local_size_x = 64) in;
#include "passes/ldm/peel_builder.glsl"
#include "passes/ldm/list_index.glsl"

uniform uint plane;

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint arrival = fragment.arrival_depth >> 16, depth = fragment.arrival_depth & 0xffffu;
    if (arrival >= MAX_LAYERS) {
        if (plane > 0u) return;
        atomicAdd(dropped, 1u);
        atomicAdd(chunk_total, 0xffffffffu);
        return;
    }
    uint entry = chunks[chunk].first + plane * plane_texels + fragment.texel;
    uint nearness = ~(depth << 16 | arrival);  // so that buffers of zeros are empty
    bool beyond = plane == 0u || nearness < planes[entry - plane_texels];
    if (beyond && planes[entry] < nearness) atomicMax(planes[entry], nearness);
}
