// How a pixel's samples and its neighbours' share in it: what their values are divided by, and the largest part that
// one sample has in the value. One loop as in reconstruct.comp. MAX_SAMPLES: there are no more for a pixel.
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"
#include "lib/luminance.glsl"

layout(rg32f) uniform writeonly image2D weights;

#if LIGHT
float size_of(Value value) { return luminance(value); }
#else
float size_of(Value value) { return value; }
#endif

vec2 shares(Target target) {
    float whole = 0.0, sum = 0.0, most = 0.0, own[MAX_SAMPLES];
    for (int s = 0; s < samples; ++s) own[s] = 0.0;
    int across = 2 * radius + 1;
    for (int i = 0; i < across * across; ++i) {
        ivec2 pixel = neighbour(target, i);
        if (!is_inside(pixel)) continue;
        float w = neighbour_weight(target, pixel);
        if (w == 0.0) continue;
        Beside beside_them = beside(target, pixel);
        for (int s = 0; s < samples; ++s) {
            Part part = part_at(target, ivec3(pixel, s));
            float theirs = w * size_of(part.value), ours = w * size_of(value_beside(target, beside_them, s));
            if (pixel == target.pixel) own[s] += theirs;
            else most = max(most, theirs);
            own[s] += ours;
            sum += theirs + ours;
            whole += w * part.share;
        }
    }
    for (int s = 0; s < samples; ++s) most = max(most, own[s]);
    return vec2(whole, sum > 0.0 ? most / sum : 0.0);
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(weights)))) return;
    Target target;
    vec2 result = vec2(0.0);
    if (target_at(pixel, target)) result = shares(target);
    imageStore(weights, pixel, vec4(result, 0.0, 0.0));
}
