// Arrays, first step: one invocation counts the fragments of one row of texels.
layout(local_size_x = 64) in;
#include "passes/ldm/array_table.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= row_count) return;
    uint sum = 0u, most = 0u, deep = 0u;
    for (uint x = 0u; x < resolution; ++x) {
        uint count = min(counts[row * resolution + x], MAX_LAYERS);
        sum += count;
        most = max(most, count);
        deep += count > FEW_LAYERS ? 1u : 0u;
    }
    rows[first_row + row] = sum;
    atomicMax(max_layers, most);
    atomicAdd(deep_texels, deep);
}
