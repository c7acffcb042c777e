// Fragments go into their texels' lists at once, without a list of fragments in between. [Aalund15 §3]
#include "passes/ldm/lists_insert.glsl"

uniform uint batch_texel;  // first texel of the chunk, in the batch

void insert_directly(uint texel, uint depth) {
    uint node = stored + reserve_fragments(1u);
    if (node < uint(nodes.length()) / 2u) insert_sorted(batch_texel + texel, node, depth);
}
