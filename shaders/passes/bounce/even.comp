// What the filter starts from: the mean of a pixel's samples, without the material, and in A the variance of its
// luminance. That is the spread of all samples about the pixel on the same surface: few of its own tell little of it,
// and nothing where all are dark. [Schied17 §4.2, where the history is short]
#include "lib/luminance.glsl"  // before what includes it for light alone
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"

uniform sampler2D moments;
uniform writeonly image2D even_image;

/// Of the pixel alone.
vec3 mean_of(vec4 sums) {
#if LIGHT
    return sums.rgb / float(samples);
#elif RATIO
    return vec3(sums.g > 0.0 ? sums.r / sums.g : 1.0);
#else
    return vec3(sums.r / float(samples));
#endif
}

float variance_about(Target target) {
    float whole = 0.0, first = 0.0, second = 0.0;
    int across = 2 * radius + 1;
    for (int i = 0; i < across * across; ++i) {
        ivec2 pixel = neighbour(target, i);
        float w = is_inside(pixel) ? neighbour_weight(target, pixel) : 0.0;
        if (w == 0.0) continue;
        vec4 sums = texelFetch(moments, pixel, 0);
        whole += w;
        first += w * luminance(mean_of(sums));
        second += w * sums.a / float(samples);
    }
    float mean = first / whole;
    return max(second / whole - mean * mean, 0.0) / float(samples);
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(even_image)))) return;
    Target target;
    vec4 even = vec4(0.0);
    if (target_at(pixel, target)) even = vec4(mean_of(texelFetch(moments, pixel, 0)), variance_about(target));
    imageStore(even_image, pixel, even);
}
