// The surfel that is explained: the chosen one, or the nearest to the picked pixel's point. FIND 1: its distance;
// 2: the first of that distance.
layout(local_size_x = 64) in;

#include "methods/deep-screen-space/records.glsl"

layout(std430, binding = 0) readonly buffer Surfels { Surfel surfels[]; };
layout(std430, binding = 1) readonly buffer Stored { uint stored; };
/// Bitwise complements, so that zeros mean none and the largest is the nearest and the first.
layout(std430, binding = 2) buffer Choice { uint nearest, first_nearest; };

layout(binding = 0) uniform sampler2D positions;

uniform uint first_item, end_item;
uniform ivec2 picked;  // negative: none
uniform uint chosen;   // 1 + index; 0: none

void main() {
    uint i = first_item + gl_GlobalInvocationID.x;
    if (i >= min(end_item, stored)) return;
#if FIND == 2
    if (chosen == i + 1u) first_nearest = ~i;
#endif
    if (chosen != 0u || picked.x < 0) return;
    vec4 x = texelFetch(positions, picked, 0);
    if (x.w == 0.0) return;
    vec3 offset = surfels[i].centre_ws - x.xyz;
    precise float squared = dot(offset, offset);
#if FIND == 1
    atomicMax(nearest, ~floatBitsToUint(squared));
#else
    if (nearest == ~floatBitsToUint(squared)) atomicMax(first_nearest, ~i);
#endif
}
