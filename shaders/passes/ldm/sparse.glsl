// Contiguous sorted arrays, with offsets for texels with fragments alone. Words stand for 32 texels: a bit for each
// with fragments; the first half of a word of their offsets (from the second such texel on), which take two halves
// each where the highest bit is set; and the first depth. depths: 16 bits, two per word.
struct LdmTexelWord {
    uint occupied, offsets, depths;
};
layout(std430) readonly buffer LdmTexelWords { LdmTexelWord texel_words[]; };
layout(std430) readonly buffer LdmSparseOffsets { uint sparse_offsets[]; };
layout(std430) readonly buffer LdmDepths { uint depths[]; };

int depth_at(uint index) {
    return int(bitfieldExtract(depths[index >> 1], int(index & 1u) << 4, 16));
}

uint offset_half(uint index) {
    return bitfieldExtract(sparse_offsets[index >> 1], int(index & 1u) << 4, 16);
}

/// From the word's first depth to that of its texel number `rank` (of those with fragments).
uint sparse_offset(LdmTexelWord word, uint rank) {
    if (rank == 0u) return 0u;
    uint first = word.offsets & 0x7fffffffu;
    if (first == word.offsets) return offset_half(first + rank - 1u);
    first += 2u * (rank - 1u);
    return offset_half(first) | offset_half(first + 1u) << 16;
}

/// Places of the texel's first depth and of the one after its last.
uvec2 depth_range(uint map, ivec2 texel, int resolution) {
    uint side = uint(resolution), in_map = uint(texel.y) * side + uint(texel.x);
    uint index = map * ((side * side + 31u) / 32u) + in_map / 32u, bit = 1u << (in_map & 31u);
    LdmTexelWord word = texel_words[index];
    if ((word.occupied & bit) == 0u) return uvec2(0u);
    uint rank = uint(bitCount(word.occupied & (bit - 1u)));
    uint end = rank + 1u == uint(bitCount(word.occupied)) ? texel_words[index + 1u].depths
                                                          : word.depths + sparse_offset(word, rank + 1u);
    return uvec2(word.depths + sparse_offset(word, rank), end);
}
