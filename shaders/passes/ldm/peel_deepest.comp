// Depth peeling, first step: the layers of the chunk's deepest texel. One invocation: one row of texels.
layout(local_size_x = 64) in;
#include "passes/ldm/peel_builder.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= row_count) return;
    uint most = 0u;
    for (uint x = 0u; x < resolution; ++x) most = max(most, counts[row * resolution + x]);
    atomicMax(chunks[chunk].planes, min(most, MAX_LAYERS));
}
