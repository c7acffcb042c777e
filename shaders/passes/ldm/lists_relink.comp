// Lists that are sorted after, last step: puts in what lists_find_next.comp found, if it had room for all of it: lists
// that are linked anew in part may never end.
layout(local_size_x = 64) in;
#include "passes/ldm/lists_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length())) || fragment_count > uint(successors.length())) return;
    LdmFragment fragment = fragments[index];
    uint node = stored + index;
    if (counts[fragment.texel] <= MAX_MERGED || fragment.arrival_depth >> 16 >= MAX_LAYERS || node >= uint(nodes.length())) return;
    uint next = successors[index];
    nodes[node].x = next & ~IS_FIRST;
    if ((next & IS_FIRST) != 0u) heads[batch_texel + fragment.texel] = node + 1u;
}
