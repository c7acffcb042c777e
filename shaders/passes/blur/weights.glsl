// What a neighbour counts for a pixel in filters that keep to surfaces: a Gaussian over pixels, as far as the one
// lies in the other's tangent plane and faces the same way. See renderers/passes/blur/blur.h, which sets the
// uniforms.

uniform int radius;  // pixels
uniform float plane_tolerance, normal_power;

struct BlurSurface {
    vec3 position, normal, geometric_normal;
};

/// Symmetric in both surfaces, and without units: a step as high as it is far away is one of 45 degrees at any
/// scale.
float off_plane(BlurSurface a, BlurSurface b) {
    vec3 way = b.position - a.position;
    float size = length(way);
    if (size == 0.0) return 0.0;
    return max(abs(dot(way, a.geometric_normal)), abs(dot(way, b.geometric_normal))) / size;
}

/// σ of the Gaussian is half the radius. `offset` in pixels.
float blur_weight(BlurSurface a, BlurSurface b, vec2 offset) {
    float sigma = 0.5 * float(radius);
    vec2 x = offset / sigma;
    float s = off_plane(a, b) / plane_tolerance;
    float facing = normal_power > 0.0 ? pow(clamp(dot(a.normal, b.normal), 0.0, 1.0), normal_power) : 1.0;
    return exp(-0.5 * dot(x, x) - s * s) * facing;
}
