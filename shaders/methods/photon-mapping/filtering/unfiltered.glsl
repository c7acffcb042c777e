// The estimate of a pixel before any filter. DIVISOR: pixels along a side of a texel of the estimate.

uniform sampler2D splat_irradiance;  // E; x of the sum of directions
uniform sampler2D splat_direction;   // y and z of it
uniform usampler2D surfaces;

struct Signal {
    vec4 value;      // E; x of the direction
    vec2 direction;  // y and z of it
};

FilterSurface surface_at(ivec2 pixel) { return unpacked_surface(texelFetch(surfaces, pixel, 0).xy); }

#if DIVISOR == 1

Signal unfiltered(ivec2 pixel, FilterSurface p) {
    return Signal(texelFetch(splat_irradiance, pixel, 0), texelFetch(splat_direction, pixel, 0).xy);
}

#else

uniform sampler2D splat_depth;

/// Bilinear; texels count less the farther their depth lies from the pixel's, beyond what a surface gains
/// within the two texels that the nearest pixel of a texel may be away. Where no texel is near, the nearest
/// in depth.
/// DEVIATION [Smal19 §7.2]: the print is bilinear alone. Light then leaks over edges, a quarter of it
/// into the first pixel behind a step at half resolution, 3/8 at quarter; on planes both are equal.
Signal unfiltered(ivec2 pixel, FilterSurface p) {
    ivec2 size = textureSize(splat_depth, 0);
    vec2 gradient = depth_gradient(p, vec2(pixel) + 0.5);
    float reach = 2.0 * float(DIVISOR) * length(gradient) + DEPTH_EPSILON * p.depth;
    vec2 place = (vec2(pixel) + 0.5) / float(DIVISOR) - 0.5;
    vec2 base = floor(place), f = place - base;
    Signal sum = Signal(vec4(0), vec2(0)), nearest = sum;
    float total = 0.0, least = NO_SURFACE;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(ivec2(base) + corner, ivec2(0), size - 1);
        vec2 share = mix(1.0 - f, f, vec2(corner));
        float difference = abs(texelFetch(splat_depth, texel, 0).x - p.depth);
        Signal s = Signal(texelFetch(splat_irradiance, texel, 0), texelFetch(splat_direction, texel, 0).xy);
        float w = share.x * share.y * exp(-max(difference - reach, 0.0) / reach);
        sum.value += w * s.value;
        sum.direction += w * s.direction;
        total += w;
        if (difference < least) {
            least = difference;
            nearest = s;
        }
    }
    if (total < 1e-4) return nearest;
    return Signal(sum.value / total, sum.direction / total);
}

#endif
