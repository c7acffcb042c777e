// What the steps share that find out where texels' depths lie in sparse arrays. A chunk's words, of 32 texels each,
// lie from first_word on in the batch.
#include "passes/ldm/state.glsl"

layout(std430) coherent buffer LdmCounts { uint counts[]; };
/// A word's texels with fragments, halves of words that their offsets take, and their depths. The highest bit of the
/// halves says that offsets take two each.
struct LdmWord {
    uint occupied, offsets, depths;
};
layout(std430) coherent buffer LdmWordSums { LdmWord sums[]; };
layout(std430) coherent buffer LdmTexelWords { LdmWord words[]; };
layout(std430) coherent buffer LdmSparseOffsets { uint offsets[]; };

const uint FEW_LAYERS = 16u;  // of array_builder.glsl
const uint WIDE = 0x80000000u;

uniform uint first_word, word_count;
uniform uint map_words, map_texels;
uniform uint depth_words;  // that there is room for

/// First texel of the chunk that a word of it stands for, and the one after its last.
uvec2 texels_of(uint word) {
    uint map = word / map_words, first = (word - map * map_words) * 32u;
    return map * map_texels + uvec2(first, min(first + 32u, map_texels));
}
