// Arrays, fourth step: one invocation puts one fragment to the others of its texel.
layout(local_size_x = 64) in;
#include "passes/ldm/array_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint arrival = fragment.arrival_depth >> 16;
    if (arrival >= MAX_LAYERS) {
        atomicAdd(dropped, 1u);
        return;
    }
    uint place = counts[fragment.texel] + arrival;
    if (place < uint(unsorted.length())) unsorted[place] = node_of(fragment);
}
