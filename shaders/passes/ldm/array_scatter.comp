// Arrays, fourth step: one invocation puts one fragment to the others of its texel.
layout(local_size_x = 64) in;
#include "passes/ldm/array_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    uvec2 fragment = fragments[index];
    uint arrival = fragment.y >> 16;
    if (arrival >= MAX_LAYERS) {
        atomicAdd(dropped, 1u);
        return;
    }
    uint place = counts[fragment.x] + arrival;
    if (place < uint(unsorted.length())) unsorted[place] = fragment.y & 0xffffu;
}
