// Arrays, seventh step, for texels that array_sort_deep.comp left: one invocation finds the place of one fragment by
// counting those that come before it.
layout(local_size_x = 64) in;
#include "passes/ldm/array_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint source = counts[fragment.texel], count = counts[fragment.texel + 1u] - source;
    uint arrival = fragment.arrival_depth >> 16, node = node_of(fragment);
    uint begin = stored_before + source;
    if (count <= MAX_INSERTED || arrival >= MAX_LAYERS) return;
    if (begin + count > node_room() || source + count > uint(unsorted.length())) return;
    uint rank = 0u;
    for (uint i = 0u; i < count; ++i) {
        uint other = unsorted[source + i];
        if (other < node || (other == node && i < arrival)) ++rank;
    }
#ifdef LDM_SLOPES
    depths[begin + rank] = node;
#else
    store_half(begin + rank, node);
#endif
}
