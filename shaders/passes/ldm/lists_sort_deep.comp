// Lists that are sorted after, fourth step: one invocation sorts the links of one texel with more than FEW_LAYERS by
// merging. The deepest are left to lists_find_next.comp.
layout(local_size_x = 64) in;
#include "passes/ldm/lists_builder.glsl"
#include "passes/ldm/list_index.glsl"

/// Merges sorted runs of `length` nodes in pairs; true when one run is left.
bool merge_runs(uint texel, uint length) {
    uint left = heads[texel], tail = 0u, merges = 0u;
    while (left != 0u) {
        ++merges;
        uint right = left, left_size = 0u, right_size = length;
        while (left_size < length && right != 0u) {
            ++left_size;
            right = nodes[right - 1u].x;
        }
        while (left_size > 0u || (right_size > 0u && right != 0u)) {
            bool take_left = right_size == 0u || right == 0u ||
                             (left_size > 0u && nodes[left - 1u].y <= nodes[right - 1u].y);
            uint taken = take_left ? left : right;
            if (take_left) {
                left = nodes[left - 1u].x;
                --left_size;
            } else {
                right = nodes[right - 1u].x;
                --right_size;
            }
            if (tail == 0u)
                heads[texel] = taken;
            else
                nodes[tail - 1u].x = taken;
            tail = taken;
        }
        left = right;
    }
    if (tail != 0u) nodes[tail - 1u].x = 0u;
    return merges <= 1u;
}

void main() {
    uint index = list_index();
    if (index >= min(deep_listed, uint(deep_list.length()))) return;
    uint texel = deep_list[index];
    if (counts[texel] > MAX_MERGED) {
        deepest_groups[0] = fragment_groups[0];
        deepest_groups[1] = fragment_groups[1];
        return;
    }
    for (uint length = 1u; length < MAX_MERGED; length *= 2u)
        if (merge_runs(batch_texel + texel, length)) break;
}
