// Packed arrays, third step: where each row begins. One work group scans the sums of all rows of the chunk.
layout(local_size_x = 256) in;
#include "passes/ldm/packed_builder.glsl"

layout(std430) buffer DepthWordsRequested { uint depth_words_requested; };

shared uint sums[256];

void main() {
    uint me = gl_LocalInvocationID.x, share = (row_count + 255u) / 256u;
    uint begin = min(me * share, row_count), end = min(begin + share, row_count);
    uint sum = 0u;
    for (uint row = begin; row < end; ++row) sum += rows[first_row + row];
    sums[me] = sum;
    barrier();
    for (uint step = 1u; step < 256u; step <<= 1) {
        uint left = me >= step ? sums[me - step] : 0u;
        barrier();
        sums[me] += left;
        barrier();
    }
    uint base = stored + (me > 0u ? sums[me - 1u] : 0u);
    for (uint row = begin; row < end; ++row) {
        uint count = rows[first_row + row];
        rows[first_row + row] = base;
        base += count;
    }
    if (me != 255u) return;
    chunk_total = sums[255];
    // One word more: the last depth may be read with the word behind it.
    uint all = stored + chunk_total;
    atomicMax(depth_words_requested, (all / BLOCK_DEPTHS + 1u) * uint(NODE_BITS) + 1u);
}
