// Lists that are sorted after, third step: how many deep texels there are, and how many nodes the batch asks for.
layout(local_size_x = 1) in;
#include "passes/ldm/list_index.glsl"
#include "passes/ldm/state.glsl"

layout(std430) buffer NodesRequested { uint nodes_requested; };

void main() {
    uvec2 groups = groups_for(deep_listed);
    deep_groups[0] = groups.x;
    deep_groups[1] = groups.y;
    deep_groups[2] = 1u;
    atomicMax(nodes_requested, requested + fragment_count);
}
