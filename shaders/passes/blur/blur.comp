// One axis of a cross-bilateral blur: neighbours count as far as they lie in the pixel's tangent plane and face
// the same way. See renderers/passes/blur/blur.h.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D image;
layout(binding = 1) uniform sampler2D position_texture;
layout(binding = 2) uniform sampler2D normal_texture;
layout(binding = 3) uniform sampler2D geometric_normal_texture;
layout(binding = 0) uniform writeonly image2D result;

uniform ivec2 axis;
uniform int radius;  // pixels
uniform float plane_tolerance, normal_power;

struct Surface {
    bool exists;
    vec3 position, normal, geometric_normal;
};

Surface surface_at(ivec2 pixel) {
    vec3 geometric_normal = texelFetch(geometric_normal_texture, pixel, 0).xyz;
    return Surface(geometric_normal != vec3(0.0), texelFetch(position_texture, pixel, 0).xyz,
                   texelFetch(normal_texture, pixel, 0).xyz, geometric_normal);
}

/// Symmetric in both surfaces, and without units: a step as high as it is far away is one of 45 degrees at any
/// scale.
float off_plane(Surface a, Surface b) {
    vec3 way = b.position - a.position;
    float size = length(way);
    if (size == 0.0) return 0.0;
    return max(abs(dot(way, a.geometric_normal)), abs(dot(way, b.geometric_normal))) / size;
}

float weight_of(Surface a, Surface b, int offset) {
    float sigma = 0.5 * float(radius), x = float(offset) / sigma;
    float s = off_plane(a, b) / plane_tolerance;
    float facing = normal_power > 0.0 ? pow(clamp(dot(a.normal, b.normal), 0.0, 1.0), normal_power) : 1.0;
    return exp(-0.5 * x * x - s * s) * facing;
}

bool is_finite(vec4 v) {
    return !any(isnan(v)) && !any(isinf(v));
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
        float w = weight_of(here, there, i);
        sum += w * (value - base);
        weights += w;
    }
    imageStore(result, pixel, weights > 0.0 ? base + sum / weights : own);
}
