// Arrays, sixth step: one invocation sorts and packs the depths of one texel with more than FEW_LAYERS. Up to 32
// are sorted in registers, more by insertion; the deepest are left to array_sort_deepest.comp.
layout(local_size_x = 64) in;
#include "passes/ldm/array_builder.glsl"
#include "passes/ldm/list_index.glsl"
#include "passes/ldm/networks.glsl"

void insert_and_pack(uint source, uint count, uint begin) {
    for (uint i = 1u; i < count; ++i) {
        uint depth = unsorted[source + i], k = i;
        while (k > 0u) {
            uint other = unsorted[source + k - 1u];
            if (other <= depth) break;
            unsorted[source + k] = other;
            --k;
        }
        unsorted[source + k] = depth;
    }
#ifdef LDM_SLOPES
    for (uint i = 0u; i < count; ++i) depths[begin + i] = unsorted[source + i];
#else
    for (uint i = begin & 1u; i + 1u < count; i += 2u)
        depths[(begin + i) >> 1] = unsorted[source + i] | unsorted[source + i + 1u] << 16;
    store_ends(unsorted[source], unsorted[source + count - 1u], begin, begin + count);
#endif
}

void main() {
    uint index = list_index();
    if (index >= min(deep_listed, uint(deep_list.length()))) return;
    uint texel = deep_list[index], source = counts[texel], count = counts[texel + 1u] - source;
    uint begin = stored_before + source, end = begin + count;
    if (end > node_room() || source + count > uint(unsorted.length())) return;
    if (count > MAX_INSERTED) {
        deepest_groups[0] = fragment_groups[0];
        deepest_groups[1] = fragment_groups[1];
        return;
    }
    if (count > 32u) {
        insert_and_pack(source, count, begin);
        return;
    }
    uint v[32];
    uint most = 0u;
    for (int i = 0; i < 32; ++i) {
        v[i] = NO_NODE;
        if (uint(i) < count) {
            v[i] = unsorted[source + uint(i)];
            most = max(most, v[i]);
        }
    }
    SORT_32(0)
    STORE_SORTED(32)
}
