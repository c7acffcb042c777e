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

/// Depth at another pixel of the plane of a pixel's surface.
float plane_depth(FilterSurface p, vec2 position_px, vec2 other_px) {
    vec3 origin = pixel_ray_origin(other_px), direction = pixel_ray_direction(other_px);
    vec3 point = pixel_ray_origin(position_px) + p.depth * pixel_ray_direction(position_px);
    return dot(p.normal, point - origin) / dot(p.normal, direction);
}

/// How well the surface of a texel's pixel goes on a pixel's, as a logarithm; 0 is in its plane.
float log_match(FilterSurface p, vec2 position_px, float slope, ivec2 texel) {
    ivec2 at = DIVISOR * texel + PIXEL_OF_TEXEL;
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(at, textureSize(surfaces, 0)))) return -NO_SURFACE;
    FilterSurface q = surface_at(at);
    if (!is_surface(q)) return -NO_SURFACE;
    float off_plane = abs(q.depth - plane_depth(p, position_px, vec2(at) + 0.5));
    float cosine = clamp(dot(p.normal, q.normal), 1e-6, 1.0);
    return sigma_normal * log(cosine) - min(off_plane / (slope + DEPTH_EPSILON * p.depth), 1e6);
}

Signal signal_of(ivec2 texel) {
    return Signal(texelFetch(splat_irradiance, texel, 0), texelFetch(splat_direction, texel, 0).xy);
}

/// Bilinear between the pixels that texels are for, as far as these are on the pixel's surface. Where none is, the
/// texel of those around that fits best.
/// DEVIATION [Smal19 §7.2]: the print is bilinear alone. Light then leaks over edges, a quarter of it
/// into the first pixel behind a step at half resolution, 3/8 at quarter; on planes both are equal.
Signal unfiltered(ivec2 pixel, FilterSurface p) {
    vec2 position_px = vec2(pixel) + 0.5;
    float slope = float(DIVISOR) * length(depth_gradient(p, position_px));
    vec2 place = vec2(pixel - PIXEL_OF_TEXEL) / float(DIVISOR);
    ivec2 base = ivec2(floor(place));
    vec2 f = place - vec2(base);
    Signal sum = Signal(vec4(0), vec2(0));
    float total = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1);
        vec2 share = mix(1.0 - f, f, vec2(corner));
        if (share.x * share.y == 0.0) continue;
        float w = share.x * share.y * exp(log_match(p, position_px, slope, base + corner));
        if (w == 0.0) continue;
        Signal s = signal_of(base + corner);
        sum.value += w * s.value;
        sum.direction += w * s.direction;
        total += w;
    }
    if (total > 1e-3) return Signal(sum.value / total, sum.direction / total);
    ivec2 best_texel = ivec2(-1);
    float best = -NO_SURFACE;
    for (int i = 0; i < 16; ++i) {
        ivec2 texel = base + ivec2(i % 4, i / 4) - 1;
        float match = log_match(p, position_px, slope, texel);
        if (match <= best) continue;
        best = match;
        best_texel = texel;
    }
    return best_texel.x < 0 ? Signal(vec4(0), vec2(0)) : signal_of(best_texel);
}

#endif
