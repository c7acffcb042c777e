// Lists that are sorted after, fifth step, for texels that lists_sort_deep.comp left: one invocation looks for the node
// that follows one fragment's in order of depth, and among equal depths of nodes.
layout(local_size_x = 64) in;
#include "passes/ldm/lists_builder.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) buffer SuccessorsRequested { uint successors_requested; };

bool precedes(uint depth, uint node, uint other_depth, uint other) {
    return depth < other_depth || (depth == other_depth && node < other);
}

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint me = stored + index + 1u, depth = fragment.arrival_depth & 0xffffu;
    if (counts[fragment.texel] <= MAX_MERGED || fragment.arrival_depth >> 16 >= MAX_LAYERS || me > uint(nodes.length())) return;
    uint next = 0u, next_depth = 65535u;
    bool is_first = true;
    for (uint node = heads[batch_texel + fragment.texel]; node != 0u;) {
        uvec2 entry = nodes[node - 1u];
        if (node != me) {
            if (precedes(entry.y, node, depth, me)) {
                is_first = false;
            } else if (next == 0u || precedes(entry.y, node, next_depth, next)) {
                next = node;
                next_depth = entry.y;
            }
        }
        node = entry.x;
    }
    atomicMax(successors_requested, fragment_count);
    if (index < uint(successors.length())) successors[index] = next | (is_first ? IS_FIRST : 0u);
}
