// Pre-sorted per-pixel linked lists. [Aalund15 §3, Lefebvre14]
// heads: first node of each texel; nodes: (next, depth). Nodes count from 1; 0 ends a list.
#ifdef LDM_WRITES
layout(std430, binding = LDM_STORAGE) coherent buffer LdmHeads { uint heads[]; };
layout(std430, binding = LDM_STORAGE + 1) coherent buffer LdmNodes { uint nodes[]; };

/// Puts node `node` (from 0) into the texel's list. Only lists grow and no link is ever taken back, so a search
/// that meets a newer node goes on from where it was. [Lefebvre14 §3.3]
void insert_sorted(uint texel, uint node, uint depth) {
    nodes[2u * node + 1u] = depth;
    uint previous = 0u, current = heads[texel], turns = 0u;
    for (;;) {
        while (current != 0u && nodes[2u * current - 1u] < depth) {
            if (++turns > MOST_LAYERS) {
                atomicAdd(dropped, 1u);
                return;
            }
            previous = current;
            current = nodes[2u * current - 2u];
        }
        nodes[2u * node] = current;
        memoryBarrierBuffer();
        uint seen = previous == 0u ? atomicCompSwap(heads[texel], current, node + 1u)
                                   : atomicCompSwap(nodes[2u * previous - 2u], current, node + 1u);
        if (seen == current) return;
        current = seen;
    }
}
#else
layout(std430, binding = LDM_STORAGE) readonly buffer LdmHeads { uint heads[]; };
layout(std430, binding = LDM_STORAGE + 1) readonly buffer LdmNodes { uvec2 nodes[]; };

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    uint node = heads[(map * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x)];
    while (node != 0u) {
        uvec2 entry = nodes[node - 1u];
        if (int(entry.y) >= depth) {
            result.behind = int(entry.y);
            break;
        }
        result.before = int(entry.y);
        node = entry.x;
    }
    return result;
}

LdmNeighbours ldm_any(uint map, ivec2 texel, int resolution, int depth, bool behind) {
    if (behind) return ldm_neighbours(map, texel, resolution, depth);
    uint node = heads[(map * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x)];
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    if (node == 0u) return result;
    int first = int(nodes[node - 1u].y);
    if (first < depth)
        result.before = first;
    else
        result.behind = first;
    return result;
}

LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    uint node = heads[(map * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x)];
    return LdmCursor(node, 0u);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at != 0u; }
int ldm_depth(LdmCursor cursor) { return int(nodes[cursor.at - 1u].y); }
LdmCursor ldm_next(LdmCursor cursor) { return LdmCursor(nodes[cursor.at - 1u].x, 0u); }
#endif
