// Lists that are sorted after, first step: one invocation puts one fragment in front of its texel's list.
layout(local_size_x = 64) in;
#include "passes/ldm/lists_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    if (fragment.arrival_depth >> 16 >= MAX_LAYERS) {
        atomicAdd(dropped, 1u);
        return;
    }
    uint node = stored + index;
    if (node >= uint(nodes.length())) return;
    nodes[node] = uvec2(atomicExchange(heads[batch_texel + fragment.texel], node + 1u), fragment.arrival_depth & 0xffffu);
}
