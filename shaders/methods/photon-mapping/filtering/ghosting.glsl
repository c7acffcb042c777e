// What of the history the present does not explain.

float largest(vec3 v) { return max(v.r, max(v.g, v.b)); }

/// α max(0, |S - μ| - σ) / max(S, μ), S the history and μ, σ of this frame's estimate around the pixel on
/// the same surface: the part that clipping to the variance of the neighbourhood would take away.
/// [Salvi16; Karis14]
float ghosting(ivec2 pixel, FilterSurface p, History history) {
    const int stride = 4;
    ivec2 size = textureSize(surfaces, 0);
    vec2 gradient = depth_gradient(p, vec2(pixel) + 0.5);
    float total = 0.0;
    vec3 m1 = vec3(0), m2 = vec3(0);
    for (int i = 0; i < 25; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2) * stride, at = pixel + offset;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
        FilterSurface q = surface_at(at);
        if (!is_surface(q)) continue;
        float expected = dot(gradient, vec2(offset));
        float w = depth_weight(q.depth - p.depth - expected, abs(expected), p.depth) *
                  normal_weight(p.normal, q.normal);
        vec3 e = unfiltered(at, q).value.rgb;
        m1 += w * e;
        m2 += w * e * e;
        total += w;
    }
    vec3 mean = m1 / total, deviation = sqrt(max(m2 / total - mean * mean, vec3(0)));
    vec3 excess = max(abs(history.signal.value.rgb - mean) - deviation, vec3(0));
    float scale = largest(max(history.signal.value.rgb, mean));
    return scale > 0.0 ? history.weight * largest(excess) / scale : 0.0;
}

/// α times the part that the present explains, and the history as much shorter.
void without_ghosts(ivec2 pixel, FilterSurface p, inout History history) {
    float kept = max(1.0 - ghosting(pixel, p, history) / history.weight, 0.0);
    history.weight *= kept;
    history.length *= kept;
}
