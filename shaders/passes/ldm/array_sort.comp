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
    if (count == 0u || end > 2u * uint(depths.length()) || source + count > uint(unsorted.length())) return;
    uint v[16];
    uint most = 0u;
    for (int i = 0; i < 16; ++i) {
        v[i] = 65535u;
        if (uint(i) < count) {
            v[i] = unsorted[source + uint(i)];
            most = max(most, v[i]);
        }
    }
    SORT_16(0)
    bool odd = (begin & 1u) != 0u;
    uint word = begin >> 1;
    store_pair(word, v[0], v[1], begin, end);
    for (int i = 1; i < 8; ++i)
        store_pair(word + uint(i), odd ? v[2 * i - 1] : v[2 * i], odd ? v[2 * i] : v[2 * i + 1], begin, end);
    store_ends(v[0], most, begin, end);
}
