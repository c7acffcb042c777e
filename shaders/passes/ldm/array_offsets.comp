// Arrays, third step: where each texel begins. One invocation: one row. A row's offsets fill whole words.
layout(local_size_x = 64) in;
#include "passes/ldm/array_table.glsl"

void write_offset_pair(uint word, uint low, uint high) {
#ifdef LDM_WIDE
    if (2u * word + 1u < uint(offsets.length())) {
        offsets[2u * word] = low;
        offsets[2u * word + 1u] = high;
    }
#else
    if (word < uint(offsets.length())) offsets[word] = min(low, 65535u) | min(high, 65535u) << 16;
#endif
}

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= row_count) return;
    uint room = NODES_PER_WORD * depth_words;
    uint unclamped = rows[first_row + row], base = min(unclamped, room);
    rows[first_row + row] = base;
    uint begin = unclamped - stored_before;  // in the chunk
    uint half_stride = (resolution + 2u) / 2u, first_word = (first_row + row) * half_stride;
    uint low = 0u;
    for (uint x = 0u; x < 2u * half_stride; ++x) {
        uint offset = min(stored_before + begin, room) - base;
        if ((x & 1u) == 0u)
            low = offset;
        else
            write_offset_pair(first_word + x / 2u, low, offset);
        if (x >= resolution) continue;
        uint count = min(counts[row * resolution + x], MAX_LAYERS);
        counts[row * resolution + x] = begin;
        begin += count;
    }
    if (row + 1u == row_count) counts[row_count * resolution] = begin;
}
