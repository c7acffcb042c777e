// Scan, second step: the sum before each tile. One work group scans the sums of all tiles, 2048 at a time.
layout(local_size_x = 256) in;
#include "passes/scan/tile.glsl"

layout(std430) buffer Bases { uint bases[]; };
layout(std430) buffer Total { uint total; };

uniform uint tile_count;

void main() {
    uint me = gl_LocalInvocationID.x, base = 0u;
    for (uint first = 0u; first < tile_count; first += SCAN_TILE) {
        for (uint word = me; word < SCAN_TILE; word += SCAN_GROUP)
            tile_words[padded(word)] = first + word < tile_count ? bases[first + word] : 0u;
        barrier();
        base += scan_tile(base);
        barrier();
        for (uint word = me; word < SCAN_TILE && first + word < tile_count; word += SCAN_GROUP)
            bases[first + word] = tile_words[padded(word)];
        barrier();
    }
    if (me == 0u) atomicAdd(total, base);
}
