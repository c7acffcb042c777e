// Pages, after pages_sort.comp: how many deep texels there are, and how many pages the batch asks for.
layout(local_size_x = 1) in;
#include "passes/ldm/pages_builder.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) buffer PagesRequested { uint pages_requested; };

void main() {
    uvec2 groups = groups_for(deep_listed);
    deep_groups[0] = groups.x;
    deep_groups[1] = groups.y;
    deep_groups[2] = 1u;
    chunk_bytes = 4u * PAGE_WORDS * (batch_extra - counted_extra);
    counted_extra = batch_extra;
    atomicMax(pages_requested, batch_extra);
}
