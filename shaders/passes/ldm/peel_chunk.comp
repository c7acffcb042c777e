// Depth peeling, second step: where the chunk's planes lie, and how many there is room for.
layout(local_size_x = 1) in;
#include "passes/ldm/peel_builder.glsl"

void main() {
    uint first = chunk == 0u ? 0u : chunks[chunk - 1u].end, deepest = chunks[chunk].planes;
    uint high, low, carry;
    umulExtended(deepest, plane_texels, high, low);
    uint end = uaddCarry(first, low, carry);
    if (high + carry > 0u) end = 0xffffffffu;  // more than any buffer holds
    atomicMax(layers_requested, deepest);
    atomicMax(planes_requested, end);
    uint room = plane_room - min(first, plane_room);
    chunks[chunk] = LdmPeeledChunk(first, min(deepest, room / plane_texels), end);
    chunk_bytes = 4u * low;
}
