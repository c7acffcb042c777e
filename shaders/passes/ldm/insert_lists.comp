// Linked lists: one invocation inserts one fragment of the chunk.
layout(local_size_x = 64) in;
#include "passes/ldm/chunk.glsl"
#include "passes/ldm/fragments.glsl"
#include "passes/ldm/list_index.glsl"
#include "passes/ldm/lists_insert.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint node = stored + index;
    if (node >= uint(nodes.length()) / 2u) return;
    insert_sorted(batch_texel + fragment.texel, node, fragment.arrival_depth & 0xffffu);
}
