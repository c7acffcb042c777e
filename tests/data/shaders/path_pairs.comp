// Random numbers of paths, for their test.
layout(local_size_x = 64) in;
#include "lib/point_sequence.glsl"
layout(std430) writeonly buffer Pairs { vec2 pairs[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    uvec2 key = sum64(pixel_key(uvec2(7u, 0xfffffff0u + i), uvec2(i % 5u, i)), uvec2(i, 0u));
    if (i < pairs.length()) pairs[i] = path_pair(key, i / 3u, i % 3u);
}
