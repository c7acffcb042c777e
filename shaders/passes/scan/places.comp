// Scan, third step: the sum before each item. One work group: one tile of 2048 items.
layout(local_size_x = 256) in;
#include "passes/scan/tile.glsl"

layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) readonly buffer Bases { uint bases[]; };
layout(std430) writeonly buffer Places { uint places[]; };

uniform uint first_tile;
uniform uint item_count, counted;  // items beyond `counted` have no words and count 0

void main() {
    uint me = gl_LocalInvocationID.x, tile = first_tile + gl_WorkGroupID.x, first = tile * SCAN_TILE;
    for (uint word = me; word < SCAN_TILE; word += SCAN_GROUP)
        tile_words[padded(word)] = first + word < counted ? counts[first + word] : 0u;
    barrier();
    scan_tile(bases[tile]);
    barrier();
    for (uint word = me; word < SCAN_TILE && first + word < item_count; word += SCAN_GROUP)
        places[first + word] = tile_words[padded(word)];
}
