// Linked lists: how many nodes the batch asks for, up to this chunk.
layout(local_size_x = 1) in;
#include "passes/ldm/state.glsl"

layout(std430) buffer NodesRequested { uint nodes_requested; };

void main() {
    atomicMax(nodes_requested, requested + fragment_count);
}
