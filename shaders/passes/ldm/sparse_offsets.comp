// Sparse arrays, third step: where each texel begins. One invocation: 32 texels. What lies beyond the buffers' capacity
// becomes empty.
layout(local_size_x = 64) in;
#include "passes/ldm/sparse_builder.glsl"

/// Writes one half of a word that another invocation may write the other half of.
void write_half(uint index, uint value) {
    int shift = int(index & 1u) << 4;
    atomicAnd(offsets[index >> 1], ~(0xffffu << shift));
    atomicOr(offsets[index >> 1], value << shift);
}

void main() {
    uint word = gl_GlobalInvocationID.x;
    if (word >= word_count) return;
    uvec2 texels = texels_of(word);
    LdmWord w = words[first_word + word];
    uint room = 2u * depth_words, base = min(w.depths, room);
    bool wide = (w.offsets & WIDE) != 0u;
    uint first = w.offsets & ~WIDE, rank = 0u, begin = w.depths - stored;  // in the chunk
    uint halves = uint(max(bitCount(w.occupied) - 1, 0)) * (wide ? 2u : 1u);
    bool fits = first + halves <= 2u * uint(offsets.length());
    for (uint texel = texels.x; texel < texels.y; ++texel) {
        uint count = min(counts[texel], MAX_LAYERS);
        counts[texel] = begin;
        if (count > 0u && rank > 0u && fits) {
            uint offset = min(stored + begin, room) - base;
            uint half_index = first + (rank - 1u) * (wide ? 2u : 1u);
            write_half(half_index, offset & 0xffffu);
            if (wide) write_half(half_index + 1u, offset >> 16);
        }
        rank += count > 0u ? 1u : 0u;
        begin += count;
    }
    words[first_word + word].depths = base;
    if (!fits) words[first_word + word].occupied = 0u;
    if (word + 1u != word_count) return;
    counts[texels.y] = begin;
    words[first_word + word_count].depths = min(stored + begin, room);
}
