// Sparse arrays, second step: where each word's offsets and depths begin. One work group scans the sums of all words of
// the chunk. The word after the chunk's last one tells the next chunk where its offsets begin.
layout(local_size_x = 256) in;
#include "passes/ldm/sparse_builder.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) buffer DepthsRequested { uint depth_words_requested; };
layout(std430) buffer OffsetsRequested { uint offset_words_requested; };
layout(std430) buffer UnsortedRequested { uint unsorted_requested; };
layout(std430) buffer MaxLayers { uint all_max_layers; };

shared uvec2 totals[256];  // halves of offsets, depths

void main() {
    uint me = gl_LocalInvocationID.x, share = (word_count + 255u) / 256u;
    uint begin = min(me * share, word_count), end = min(begin + share, word_count);
    uint chunk_offsets = first_word > 0u ? words[first_word].offsets : 0u;
    uvec2 sum = uvec2(0u);
    for (uint word = begin; word < end; ++word) sum += uvec2(sums[word].offsets & ~WIDE, sums[word].depths);
    totals[me] = sum;
    barrier();
    for (uint step = 1u; step < 256u; step <<= 1) {
        uvec2 left = me >= step ? totals[me - step] : uvec2(0u);
        barrier();
        totals[me] += left;
        barrier();
    }
    uvec2 base = uvec2(chunk_offsets, stored) + (me > 0u ? totals[me - 1u] : uvec2(0u));
    for (uint word = begin; word < end; ++word) {
        words[first_word + word] = LdmWord(sums[word].occupied, base.x | (sums[word].offsets & WIDE), base.y);
        base += uvec2(sums[word].offsets & ~WIDE, sums[word].depths);
    }
    if (me != 255u) return;
    uvec2 total = totals[255];
    words[first_word + word_count] = LdmWord(0u, chunk_offsets + total.x, stored + total.y);
    chunk_total = total.y;
    chunk_bytes = 2u * total.x;
    uvec2 groups = groups_for(deep_texels);
    deep_groups[0] = groups.x;
    deep_groups[1] = groups.y;
    deep_groups[2] = 1u;
    atomicMax(depth_words_requested, (requested + fragment_count + 1u) / 2u);
    atomicMax(offset_words_requested, (chunk_offsets + total.x + 1u) / 2u);
    atomicMax(unsorted_requested, fragment_count);
    atomicMax(all_max_layers, max_layers);
}
