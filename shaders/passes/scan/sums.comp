// Scan, first step: the sum of each tile of 2048 counts. One work group: one tile.
layout(local_size_x = 256) in;
#include "passes/scan/tile.glsl"

layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) writeonly buffer Bases { uint bases[]; };

uniform uint first_tile, counted;

void main() {
    uint me = gl_LocalInvocationID.x, tile = first_tile + gl_WorkGroupID.x;
    uint sum = 0u, total;
    for (uint i = 0u; i < SCAN_SHARE; ++i) {
        uint item = tile * SCAN_TILE + i * SCAN_GROUP + me;
        if (item < counted) sum += counts[item];
    }
    scanned_group(sum, total);
    if (me == 0u) bases[tile] = total;
}
