// The surfel that is explained: the chosen one, or the nearest to the picked pixel's point. FIND 1: its distance;
// 2: the last of that distance.
layout(local_size_x = 64) in;

#include "methods/deep-screen-space/records.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer Stored { uint stored, made; };
/// Bits of the greatest 1 / distance², and of those as near the last one's 1 + index; zeros: none.
layout(std430) buffer Choice { uint closeness, surfel; };

uniform sampler2D gbuffer_position;

uniform uint first_item, end_item;
uniform ivec2 picked;  // negative: none
uniform uint chosen;   // 1 + index; 0: none

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= min(end_item, stored)) return;
#if FIND == 2
    if (chosen == i + 1u) surfel = chosen;
#endif
    if (chosen != 0u || picked.x < 0) return;
    vec4 x = texelFetch(gbuffer_position, picked, 0);
    if (x.w == 0.0) return;
    vec3 offset = surfels[i].centre_ws - x.xyz;
    precise float squared = dot(offset, offset), inverse = 1.0 / max(squared, 1e-30);
#if FIND == 1
    atomicMax(closeness, floatBitsToUint(inverse));
#else
    if (closeness == floatBitsToUint(inverse)) atomicMax(surfel, i + 1u);
#endif
}
