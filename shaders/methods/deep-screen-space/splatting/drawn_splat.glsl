// Whether the splat of a surfel on a level is drawn, and where. DARK_IS_IDLE: surfels that send no light are not.
// Include records.glsl before it.
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/sphere_bounds.glsl"

#if DARK_IS_IDLE
layout(std430) readonly buffer SurfelLights { SurfelLight surfel_lights[]; };
#endif

uniform bool culls, shells;

const int SPLAT_ABSENT = 0;  // nothing of its shell is in the picture
const int SPLAT_CULLED = 1;  // nothing that the picture shows there lies within its shell
const int SPLAT_DRAWN = 2;

struct DrawnSplat {
    int fate;
    PixelRange range;  // of the picture; where it is drawn
};

// DEVIATION [Nalbach14]: "depending on the estimated influence" [Nalbach15 §4.1] leaves open which; there it also
// depends on the radiance that is sent, which here only counts as none or some, as ε would else depend on exposure.
bool is_idle(uint surfel) {
#if DARK_IS_IDLE
    return is_dark(surfel_lights[surfel]);
#else
    return false;
#endif
}

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

/// Texels of the bounds that are looked at for a splat, along either side.
const int MAX_TEXELS = 8;

/// The part of the range of pixels in which surfaces are seen that lie in the shell, as the texels of the finest mip
/// level tell on which the range touches few.
// DEVIATION [Nalbach15 §4.3]: there all pixels fall into one texel, which for a range across the picture's
// middle is the last one, with the bounds of everything, and the whole range is drawn.
PixelRange reached_part(PixelRange range, vec3 centre, float radius, float inner) {
    int level = 0, coarsest = textureQueryLevels(min_texture) - 1;
    while (level < coarsest && any(greaterThanEqual((range.last >> level) - (range.first >> level), ivec2(MAX_TEXELS))))
        ++level;
    // Not textureSize: software rasterisers give all invocations the size of the first one's level.
    ivec2 size = max(view_size >> level, 1);
    ivec2 begin = min(range.first >> level, size - 1), end = min(range.last >> level, size - 1);
    ivec2 first = size, last = ivec2(-1);
    for (int y = begin.y; y <= end.y; ++y)
        for (int x = begin.x; x <= end.x; ++x)
            if (is_box_reached(texelFetch(min_texture, ivec2(x, y), level).xyz,
                               texelFetch(max_texture, ivec2(x, y), level).xyz, centre, radius, inner)) {
                first = min(first, ivec2(x, y));
                last = max(last, ivec2(x, y));
            }
    if (last.x < 0) return NO_PIXELS;
    // The last texel of a row also covers what halving left over.
    ivec2 end_pixel = mix((last + 1 << level) - 1, view_size - 1, equal(last, size - 1));
    return PixelRange(max(range.first, first << level), min(range.last, end_pixel));
}

DrawnSplat drawn_splat(Surfel surfel, uint index, int level) {
    DrawnSplat absent = DrawnSplat(SPLAT_ABSENT, NO_PIXELS);
    if (surfel.radius == 0.0 || is_idle(index)) return absent;  // there is a hole
    Shell shell = shell_of(surfel.radius, level);
    if (shell.inner >= shell.outer) return absent;
    PixelRange range = pixels_of_sphere(surfel.centre_ws, shell.outer);
    if (any(lessThan(range.last, range.first))) return absent;
    if (!culls) return DrawnSplat(SPLAT_DRAWN, range);
    range = reached_part(range, surfel.centre_ws, shell.outer, shells ? shell.inner : 0.0);
    return DrawnSplat(any(lessThan(range.last, range.first)) ? SPLAT_CULLED : SPLAT_DRAWN, range);
}
