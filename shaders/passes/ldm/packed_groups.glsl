// Where the depths of a texel of packed arrays are. Eight texels of a row share two words: where their first depth is,
// counted from the row's, and their numbers of depths, six bits each. Where these are too many, the words hold
// WIDE_GROUP and the place, in the same buffer, of nine words: where each of the texels begins, and where they end.
const uint GROUP_TEXELS = 8u, GROUP_WORDS = 2u, WIDE_WORDS = 9u;
const uint WIDE_GROUP = 0xffffu, MAX_IN_GROUP = 63u;
/// Depths of a block begin with a word: 32 of them take NODE_BITS words.
const uint BLOCK_DEPTHS = 32u;

uint groups_of_row(uint resolution) {
    return (resolution + GROUP_TEXELS - 1u) / GROUP_TEXELS;
}

/// x: begin, 16 bits, below the counts of texels 5 and 6 and four bits of that of texel 7; y: counts of texels 0 to 4,
/// below the other two bits of texel 7.
uvec2 group_words(uint begin, uint counts[8]) {
    uvec2 words = uvec2(begin | counts[5] << 16 | counts[6] << 22 | counts[7] << 28, (counts[7] >> 4) << 30);
    for (int i = 0; i < 5; ++i) words.y |= counts[i] << (6 * i);
    return words;
}

/// Where the depths of texel `t` of a group begin and end, counted from the row's first.
uvec2 group_range(uvec2 words, uint t) {
    uint before = words.y & ((1u << (6u * min(t, 5u))) - 1u);
    // Sums of pairs of counts, then of all.
    uint pairs = (before & 0x3f03f03fu) + ((before >> 6) & 0x3f03f03fu);
    uint begin = (words.x & 0xffffu) + ((pairs + (pairs >> 12) + (pairs >> 24)) & 0xfffu);
    uint fifth = bitfieldExtract(words.x, 16, 6), sixth = bitfieldExtract(words.x, 22, 6);
    begin += (t > 5u ? fifth : 0u) + (t > 6u ? sixth : 0u);
    uint count = t < 5u ? bitfieldExtract(words.y, int(6u * min(t, 4u)), 6)
                        : t == 5u ? fifth : t == 6u ? sixth : words.x >> 28 | (words.y >> 30) << 4;
    return uvec2(begin, begin + count);
}

/// Word and bit of a depth.
uvec2 packed_place(uint index) {
    uint bit = (index % BLOCK_DEPTHS) * uint(NODE_BITS);
    return uvec2(index / BLOCK_DEPTHS * uint(NODE_BITS) + bit / 32u, bit % 32u);
}
