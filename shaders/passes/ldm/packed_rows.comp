// Packed arrays, second step: one invocation sums the depths of one row of texels.
layout(local_size_x = 64) in;
#include "passes/ldm/packed_builder.glsl"

void main() {
    uint row = gl_GlobalInvocationID.x;
    if (row >= row_count) return;
    uint sum = 0u;
    for (uint x = 0u; x < resolution; ++x) sum += packed_texels[row * resolution + x];
    rows[first_row + row] = sum;
}
