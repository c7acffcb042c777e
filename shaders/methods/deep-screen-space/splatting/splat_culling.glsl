// Whether any surface seen in a range of pixels lies within a sphere; after sphere_bounds.glsl.
// [Nalbach15 §4.3]

uniform sampler2D min_texture;
uniform sampler2D max_texture;

/// The box touches the ball around `centre` and does not lie within `inner` of it.
bool is_box_reached(vec3 least, vec3 most, vec3 centre, float radius, float inner) {
    if (least.x > most.x) return false;
    vec3 nearest = max(max(least - centre, centre - most), 0.0);
    vec3 farthest = max(abs(least - centre), abs(most - centre));
    // As far as rounding goes.
    return length(nearest) <= 1.0001 * radius && length(farthest) >= 0.9999 * inner;
}

/// On the finest mip level on which the range touches at most 2 × 2 texels.
// DEVIATION [Nalbach15 §4.3]: there all pixels fall into one texel, which for a range across the picture's
// middle is the last one, with the bounds of everything.
bool is_range_reached(ivec2 first, ivec2 last, vec3 centre, float radius, float inner) {
    ivec2 extent = last - first;
    int level = min(findMSB(max(extent.x, extent.y)) + 1, textureQueryLevels(min_texture) - 1);
    // Not textureSize: software rasterisers give all invocations the size of the first one's level.
    ivec2 size = max(view_size >> level, 1);
    ivec2 begin = min(first >> level, size - 1), end = min(last >> level, size - 1);
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x)
            if (is_box_reached(texelFetch(min_texture, ivec2(x, y), level).xyz,
                               texelFetch(max_texture, ivec2(x, y), level).xyz, centre, radius, inner))
                return true;
    return false;
}
