// From samples to pixels: each pixel makes of its own samples and its neighbours' what its surface reflects, or how
// open it is. One loop over neighbours and one over their samples, (2 radius + 1)² (samples + 2) turns in all
// as llvmpipe counts them, which stay below 65,535, where it stops. [Nalbach15 §3.3]
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"

#if LIGHT
layout(rgba32f) uniform writeonly image2D result;
const vec4 EMPTY = vec4(0.0);
#else
layout(r32f) uniform writeonly image2D result;
const vec4 EMPTY = vec4(1.0);
#endif

vec4 estimate(Target target) {
    Value sum = Value(0.0);
    float whole = 0.0;
    int across = 2 * radius + 1;
    for (int i = 0; i < across * across; ++i) {
        ivec2 pixel = neighbour(target, i);
        if (!is_inside(pixel)) continue;
        float w = neighbour_weight(target, pixel);
        if (w == 0.0) continue;
        Beside own = beside(target, pixel);
        for (int s = 0; s < samples; ++s) {
            Part part = part_at(target, ivec3(pixel, s));
            sum += w * (part.value + value_beside(target, own, s));
            whole += w * part.share;
        }
    }
    if (whole == 0.0) return EMPTY;
#if LIGHT
    return vec4(sum / whole, 0.0);
#else
    return vec4(sum / whole);
#endif
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    Target target;
    imageStore(result, pixel, target_at(pixel, target) ? estimate(target) : EMPTY);
}
