// Fixed arrays, first step: one invocation puts one fragment into its texel's array, in order of arrival, or where
// FIXED_PRESORTED is defined, in order of depth.
layout(local_size_x = 64) in;
#include "passes/ldm/fragments.glsl"
#include "passes/ldm/list_index.glsl"

/// 65535 - depth, so that an array of zeros is empty.
layout(std430) coherent buffer LdmFixedChunk { uint nearness_of[]; };

void drop() {
    atomicAdd(dropped, 1u);
    atomicAdd(chunk_total, 0xffffffffu);
}

/// Each place keeps the nearer one of what it holds and what comes, and hands on the other: after any order of
/// exchanges the nearest ones stay, sorted. [Liu10 §3.1]
void insert(uint first, uint nearness) {
    for (uint i = first; i < first + FIXED_LAYERS && nearness != 0u; ++i)
        if (nearness_of[i] < nearness)  // places only get nearer
            nearness = min(nearness, atomicMax(nearness_of[i], nearness));
    if (nearness != 0u) drop();
}

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint first = fragment.texel * FIXED_LAYERS, nearness = 65535u - (fragment.arrival_depth & 0xffffu);
#ifdef FIXED_PRESORTED
    insert(first, nearness);
#else
    uint arrival = fragment.arrival_depth >> 16;
    if (arrival < FIXED_LAYERS)
        nearness_of[first + arrival] = nearness;
    else
        drop();
#endif
}
