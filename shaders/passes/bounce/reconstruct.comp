// From samples to pixels: each pixel makes of its own samples and its neighbours' what its surface reflects, or how
// open it is. One loop over neighbours and one over their samples, (2 radius + 1)² (samples + 2) turns in all
// as llvmpipe counts them, which stay below 65,535, where it stops. BEGINS, ENDS: the sums do with
// these samples; else others come before or go on. [Nalbach15 §3.3]
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"

#if !ENDS && BEGINS
layout(rgba32f) uniform writeonly image2D sums;
#elif !ENDS
layout(rgba32f) uniform image2D sums;
#elif LIGHT
layout(rgba32f) uniform writeonly image2D result;
#else
layout(r32f) uniform writeonly image2D result;
#endif
#if ENDS && !BEGINS
uniform sampler2D carried;
#endif
#if ENDS
#define RESULT result
#else
#define RESULT sums
#endif
#if LIGHT || !ENDS
const vec4 EMPTY = vec4(0.0);
#else
const vec4 EMPTY = vec4(1.0);
#endif

uniform int first_layer;

/// Of the samples before: RGB or R of values, A of shares.
vec4 sums_before(ivec2 pixel) {
#if BEGINS
    return vec4(0.0);
#elif ENDS
    return texelFetch(carried, pixel, 0);
#else
    return imageLoad(sums, pixel);
#endif
}

vec4 estimate(Target target) {
    vec4 before = sums_before(target.pixel);
    float whole = before.a;
#if LIGHT
    Value sum = before.rgb;
#else
    Value sum = before.r;
#endif
    int across = 2 * radius + 1;
    for (int i = 0; i < across * across; ++i) {
        ivec2 pixel = neighbour(target, i);
        if (!is_inside(pixel)) continue;
        float w = neighbour_weight(target, pixel);
        if (w == 0.0) continue;
        Beside own = beside(target, pixel);
        for (int s = 0; s < samples; ++s) {
            Part part = part_at(target, ivec3(pixel, first_layer + s));
            sum += w * (part.value + value_beside(target, own, first_layer + s));
            whole += w * part.share;
        }
    }
#if !ENDS
    return vec4(vec3(sum), whole);
#endif
    if (whole == 0.0) return EMPTY;
#if LIGHT
    return vec4(sum / whole, 0.0);
#else
    return vec4(sum / whole);
#endif
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(RESULT)))) return;
    Target target;
    imageStore(RESULT, pixel, target_at(pixel, target) ? estimate(target) : EMPTY);
}
