// Arrays, fifth step: one invocation sorts one texel's depths in registers and packs them. Texels with more than
// FEW_LAYERS are listed for array_sort_deep.comp, where they do not hold up their neighbours.
layout(local_size_x = 128) in;
#include "passes/ldm/array_builder.glsl"
#include "passes/ldm/networks.glsl"

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel >= row_count * resolution) return;
    uint source = counts[texel], count = counts[texel + 1u] - source;
    uint begin = stored_before + source, end = begin + count;
    if (count > FEW_LAYERS) {
        uint place = atomicAdd(deep_listed, 1u);
        if (place < uint(deep_list.length())) deep_list[place] = texel;
        return;
    }
    if (count == 0u || end > node_room() || source + count > uint(unsorted.length())) return;
    uint v[16];
    uint most = 0u;
    for (int i = 0; i < 16; ++i) {
        v[i] = NO_NODE;
        if (uint(i) < count) {
            v[i] = unsorted[source + uint(i)];
            most = max(most, v[i]);
        }
    }
    SORT_16(0)
    STORE_SORTED(16)
}
