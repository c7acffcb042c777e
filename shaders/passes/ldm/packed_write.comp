// Packed arrays, last step: one invocation packs the depths of one texel. Words were cleared before, and may be shared
// with other texels.
layout(local_size_x = 128) in;
#include "passes/ldm/packed_builder.glsl"

layout(std430) buffer GroupWordsRequested { uint group_words_requested; };

void main() {
    uint texel = gl_GlobalInvocationID.x;
    if (texel == 0u) {
        chunk_bytes = 4u * WIDE_WORDS * (batch_extra - counted_extra);
        counted_extra = batch_extra;
        atomicMax(group_words_requested, table_words + WIDE_WORDS * batch_extra);
    }
    if (texel >= row_count * resolution || !has_sorted(texel)) return;
    uint begin = counts[texel], end = counts[texel + 1u], first = packed_texels[texel];
    if (begin == end || packed_texels[texel + 1u] > packed_room()) return;
    uvec2 place = packed_place(first);
    uint word = place.x, shift = place.y, bits = 0u, last = 0xffffffffu;
    for (uint i = begin; i < end; ++i) {
        uint depth = sorted_at(i);
        if (depth == last) continue;
        last = depth;
        bits |= depth << shift;
        shift += uint(NODE_BITS);
        if (shift < 32u) continue;
        atomicOr(depths[word++], bits);
        shift -= 32u;
        bits = shift > 0u ? depth >> (uint(NODE_BITS) - shift) : 0u;
    }
    if (shift > 0u) atomicOr(depths[word], bits);
}
