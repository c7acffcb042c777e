// After the first step of rasterising (PREPARE_LARGE), after the second, and when a chunk is stored (FINISH):
// the sizes of the indirect dispatches that follow, and what the report and the growth of buffers need.
layout(local_size_x = 1) in;
#include "passes/ldm/state.glsl"
#include "passes/ldm/list_index.glsl"

#if defined(PREPARE_LARGE)
layout(std430) buffer LargeRequested { uint large_requested; };
uniform uint large_capacity;
#elif defined(FINISH)
layout(std430) buffer Generated { uint generated; };
layout(std430) buffer Dropped { uint all_dropped; };
layout(std430) buffer Kept { uint kept; };
layout(std430) buffer Bytes { uint bytes; };
uniform uint fragment_bits;  // that the maps take for each
#elif !defined(DIRECT)
uniform uint fragment_capacity;
layout(std430) buffer FragmentsRequested { uint fragments_requested; };
#endif

void main() {
#if defined(PREPARE_LARGE)
    uvec2 groups = groups_for(min(large_count, large_capacity));
    large_groups[0] = groups.x;
    large_groups[1] = groups.y;
    large_groups[2] = 1u;
    atomicMax(large_requested, large_count);
#elif defined(FINISH)
    atomicAdd(generated, fragment_count);
    atomicAdd(all_dropped, dropped);
    atomicAdd(kept, chunk_total);
    atomicAdd(bytes, chunk_total / 8u * fragment_bits + chunk_total % 8u * fragment_bits / 8u + chunk_bytes);
    requested += fragment_count;
    stored += chunk_total;
    dropped = 0u;
    chunk_bytes = 0u;
    fragment_count = 0u;
    large_count = 0u;
    deep_texels = 0u;
    deep_listed = 0u;
#else
    chunk_total = fragment_count;
#ifndef DIRECT
    uvec2 groups = groups_for(min(fragment_count, fragment_capacity));
    fragment_groups[0] = groups.x;
    fragment_groups[1] = groups.y;
    fragment_groups[2] = 1u;
    atomicMax(fragments_requested, fragment_count);
    deepest_groups[0] = 0u;
    deepest_groups[1] = 1u;
    deepest_groups[2] = 1u;
#endif
#endif
}
