// The picture: what the filter left, with the material put back in.
#include "passes/bounce/tiles.glsl"
#include "passes/bounce/filter.glsl"
#include "passes/bounce/even.glsl"

uniform sampler2D even_image;
#if LIGHT
layout(rgba32f) uniform writeonly image2D result;
#else
layout(r32f) uniform writeonly image2D result;
#endif

void main() {
    ivec2 pixel = tile_pixel();
    if (any(greaterThanEqual(pixel, imageSize(result)))) return;
    Target target;
    bool exists = target_at(pixel, target);
    vec4 even = texelFetch(even_image, pixel, 0);
#if LIGHT
    imageStore(result, pixel, exists ? vec4(even.rgb * divisor_of(target), 0.0) : vec4(0.0));
#else
    imageStore(result, pixel, vec4(exists ? even.r : 1.0));
#endif
}
