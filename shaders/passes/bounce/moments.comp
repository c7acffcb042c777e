// Sums over a pixel's own samples, without the material. Light: RGB of values, A of squared luminances. Ambient
// occlusion: R of values, G of shares, A of squared values. BEGINS: other samples have not been added yet.
#include "lib/luminance.glsl"  // before what includes it for light alone
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"
#include "passes/bounce/even.glsl"

#if BEGINS
layout(rgba32f) uniform writeonly image2D moments;
#else
layout(rgba32f) uniform image2D moments;
#endif

vec4 moments_of(Part part, Target target) {
#if LIGHT
    vec3 even = part.value / divisor_of(target);
    float size = luminance(even);
    return vec4(even, size * size);
#else
    return vec4(part.value, part.share, 0.0, part.value * part.value);
#endif
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(moments)))) return;
    Target target;
    vec4 sum = vec4(0.0);
    if (target_at(pixel, target)) {
#if !BEGINS
        sum = imageLoad(moments, pixel);
#endif
        for (int s = 0; s < samples; ++s) sum += moments_of(part_at(target, ivec3(pixel, s)), target);
    }
    imageStore(moments, pixel, sum);
}
