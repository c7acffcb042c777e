// One axis of a cross-bilateral blur: neighbours count as far as they lie in the pixel's tangent plane and face
// the same way. See renderers/passes/blur/blur.h.
layout(local_size_x = 8, local_size_y = 8) in;

#include "lib/floats.glsl"
#include "passes/blur/weights.glsl"

uniform sampler2D image;
uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform sampler2D gbuffer_geometric_normal;
uniform writeonly image2D result;

uniform ivec2 axis;

struct Surface {
    bool exists;
    BlurSurface at;
};

Surface surface_at(ivec2 pixel) {
    vec3 geometric_normal = texelFetch(gbuffer_geometric_normal, pixel, 0).xyz;
    return Surface(geometric_normal != vec3(0.0),
                   BlurSurface(texelFetch(gbuffer_position, pixel, 0).xyz,
                               texelFetch(gbuffer_normal, pixel, 0).xyz, geometric_normal));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
    if (any(greaterThanEqual(pixel, size))) return;
    vec4 own = texelFetch(image, pixel, 0);
    Surface here = surface_at(pixel);
    if (!here.exists || radius == 0) {
        imageStore(result, pixel, own);
        return;
    }
    // Differences to the pixel's own value are averaged, so that a constant stays the same to the bit.
    bool finite = is_finite(own);
    vec4 base = finite ? own : vec4(0.0), sum = vec4(0.0);
    float weights = finite ? 1.0 : 0.0;
    for (int i = -radius; i <= radius; ++i) {
        ivec2 place = pixel + i * axis;
        if (i == 0 || any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, size))) continue;
        Surface there = surface_at(place);
        vec4 value = texelFetch(image, place, 0);
        if (!there.exists || !is_finite(value)) continue;
        float w = blur_weight(here.at, there.at, vec2(i * axis));
        sum += w * (value - base);
        weights += w;
    }
    imageStore(result, pixel, weights > 0.0 ? base + sum / weights : own);
}
