// Arrays, second step: where each row begins. One work group scans the sums of all rows of the chunk.
layout(local_size_x = 256) in;
#include "passes/ldm/array_table.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) buffer DepthsRequested { uint depth_words_requested; };
layout(std430) buffer OffsetsRequested { uint offset_words_requested; };
layout(std430) buffer UnsortedRequested { uint unsorted_requested; };
layout(std430) buffer MaxLayers { uint all_max_layers; };

shared uint sums[256];
shared uint widest[256];

void main() {
    uint me = gl_LocalInvocationID.x, share = (row_count + 255u) / 256u;
    uint begin = min(me * share, row_count), end = min(begin + share, row_count);
    uint sum = 0u, wide = 0u;
    for (uint row = begin; row < end; ++row) {
        sum += rows[first_row + row];
        wide = max(wide, rows[first_row + row]);
    }
    sums[me] = sum;
    widest[me] = wide;
    barrier();
    for (uint step = 1u; step < 256u; step <<= 1) {
        uint left = me >= step ? sums[me - step] : 0u, left_widest = me >= step ? widest[me - step] : 0u;
        barrier();
        sums[me] += left;
        widest[me] = max(widest[me], left_widest);
        barrier();
    }
    uint base = stored_before + (me > 0u ? sums[me - 1u] : 0u);
    for (uint row = begin; row < end; ++row) {
        uint count = rows[first_row + row];
        rows[first_row + row] = base;
        base += count;
    }
    if (me != 255u) return;
    chunk_total = sums[255];
    uvec2 groups = groups_for(deep_texels);
    deep_groups[0] = groups.x;
    deep_groups[1] = groups.y;
    deep_groups[2] = 1u;
    atomicMax(depth_words_requested, (requested_before + fragment_count + NODES_PER_WORD - 1u) / NODES_PER_WORD);
    atomicMax(offset_words_requested, widest[255] > 65535u ? wide_words : packed_words);
    atomicMax(unsorted_requested, fragment_count);
    atomicMax(all_max_layers, max_layers);
}
