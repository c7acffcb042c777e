// Inserts into the lists of lists.glsl.
layout(std430) coherent buffer LdmHeads { uint heads[]; };
layout(std430) coherent buffer LdmNodes { uint nodes[]; };

/// Puts node `node` (from 0) into the texel's list. Only lists grow and no link is ever taken back, so a search
/// that meets a newer node goes on from where it was. [Lefebvre14 §3.3]
void insert_sorted(uint texel, uint node, uint depth) {
    nodes[2u * node + 1u] = depth;
    uint previous = 0u, current = heads[texel], turns = 0u;
    for (;;) {
        while (current != 0u && nodes[2u * current - 1u] < depth) {
            if (++turns > MAX_LAYERS) {
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
