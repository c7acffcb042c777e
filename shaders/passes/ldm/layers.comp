// The number of depths at each texel of a map; of several maps the most.
layout(local_size_x = 8, local_size_y = 8) in;
#include "passes/ldm/frames.glsl"
#include "passes/ldm/storage.glsl"

layout(r32ui) uniform uimage2D layers;
uniform uint map;  // in the batch
uniform bool first;
uniform int resolution;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(resolution)))) return;
    uint count = 0u;
    for (LdmCursor c = ldm_first(map, texel, resolution); ldm_valid(c); c = ldm_next(c)) ++count;
    if (!first) count = max(count, imageLoad(layers, texel).x);
    imageStore(layers, texel, uvec4(count));
}
