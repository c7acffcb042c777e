// Random numbers of paths, for their test.
layout(local_size_x = 64) in;
#include "lib/point_sequence.glsl"
layout(std430) writeonly buffer Pairs { vec2 pairs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= pairs.length()) return;
    uvec2 key = sum64(pixel_key(uvec2(7u, 0xfffffff0u + i), uvec2(i % 5u, i)), uvec2(i, 0u));
    // Compilers fold what is constant, which goes wrong in ways of its own.
    if (i % 3u == 0u) pairs[i] = path_pair(key, i / 3u, 0u);
    else if (i % 3u == 1u) pairs[i] = path_pair(key, i / 3u, 1u);
    else pairs[i] = path_pair(key, i / 3u, 2u);
}
