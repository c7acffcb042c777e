// How far each pixel's kernel reaches: no farther than some times the distance at which rays about it meet something.
// [Nalbach15 §6: "adaptive kernel sizes"]
// DEVIATION: the paper has the idea alone. The kernel follows from the samples that it then averages, so that few of
// them bias the mean (measured in docs/accuracy.md).
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"
#include "lib/pixel_rays.glsl"

uniform sampler2DArray distances;
layout(r32f) uniform writeonly image2D kernel_image;

uniform float kernel_by_distance;

/// Pixels on either side whose rays are asked.
const int ABOUT = 2;
/// Pixels: of the narrowest kernel.
const float MIN_KERNEL = 0.5;

/// 1/m, mean over the rays of the pixels about; of rays that met nothing 0.
float closeness(Target target) {
    float sum = 0.0, whole = 0.0;
    for (int i = 0; i < (2 * ABOUT + 1) * (2 * ABOUT + 1); ++i) {
        ivec2 pixel = target.pixel + ivec2(i % (2 * ABOUT + 1), i / (2 * ABOUT + 1)) - ABOUT;
        if (!is_inside(pixel)) continue;
        float w = neighbour_weight(target, pixel);
        if (w == 0.0) continue;
        for (int s = 0; s < samples; ++s) {
            float met = texelFetch(distances, ivec3(pixel, s), 0).x;
            sum += met < 0.0 ? 0.0 : w / max(met, 1e-6);
        }
        whole += w * float(samples);
    }
    return sum / whole;
}

/// m, at the target.
float pixel_size(Target target) {
    if (!is_perspective()) return length(ray_origin_dx);
    vec3 direction = pixel_ray_direction(vec2(target.pixel) + 0.5);
    return length(ray_direction_dx) * texelFetch(gbuffer_position, target.pixel, 0).w / length(direction);
}

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(kernel_image)))) return;
    Target target;
    float kernel = float(radius);
    if (target_at(pixel, target)) {
        float close = closeness(target) * pixel_size(target);
        if (close > 0.0) kernel = clamp(kernel_by_distance / close, MIN_KERNEL, kernel);
    }
    imageStore(kernel_image, pixel, vec4(kernel));
}
