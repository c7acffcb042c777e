// Pre-sorted per-pixel linked lists. [Aalund15 §3, Lefebvre14]
// heads: first node of each texel; nodes: (next, depth). Nodes count from 1; 0 ends a list.
layout(std430) readonly buffer LdmHeads { uint heads[]; };
layout(std430) readonly buffer LdmNodes { uvec2 nodes[]; };

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

LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    uint node = heads[(map * uint(resolution) + uint(texel.y)) * uint(resolution) + uint(texel.x)];
    return LdmCursor(node, 0u);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at != 0u; }
int ldm_depth(LdmCursor cursor) { return int(nodes[cursor.at - 1u].y); }
LdmCursor ldm_next(LdmCursor cursor) { return LdmCursor(nodes[cursor.at - 1u].x, 0u); }
