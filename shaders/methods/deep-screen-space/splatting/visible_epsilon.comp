// How coarse the surfels are that were hit: (r 2^k / t)², with k the shell that x_p lies in. Up to π it is the
// solid angle of the disc that stands for them, seen face on; at the outer border of a shell it is ε = (r / d)².
// [Nalbach15 fig. 9]
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/visible_hit.glsl"
#include "methods/deep-screen-space/splatting/exact.glsl"
#include "passes/bounce/tiles.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };

uniform usampler2DArray nearest;
uniform sampler2DArray levels;
uniform sampler2DArray distances;
uniform sampler2D gbuffer_position;
layout(r32f) uniform writeonly image2DArray epsilon_image;

float epsilon_of(ivec3 at) {
    uint winner = texelFetch(nearest, at, 0).x;
    if (winner == 0u || (winner & EXACT_HIT) != 0u) return 0.0;
    Surfel s = surfels[winner - 1u];
    SplatLevel l = splat_level(int(texelFetch(levels, at, 0).x), s);
    int shell = max(splat_shell(l, texelFetch(gbuffer_position, at.xy, 0).xyz, s.centre_ws), 0);
    float ratio = ldexp(s.radius, shell) / max(texelFetch(distances, at, 0).x, 1e-12);
    return min(ratio * ratio, 1e12);
}

void main() {
    ivec2 pixel = tile_pixel();
    ivec3 size = imageSize(epsilon_image);
    if (any(greaterThanEqual(pixel, size.xy))) return;
    for (int i = 0; i < size.z; ++i)
        imageStore(epsilon_image, ivec3(pixel, i), vec4(epsilon_of(ivec3(pixel, i))));
}
