// Where a surfel is splatted, found for one pixel: what rectangles.comp finds for all.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"
#include "methods/deep-screen-space/splatting/sphere_bounds.glsl"
#include "methods/deep-screen-space/splatting/sub_image.glsl"
#include "methods/deep-screen-space/splatting/visible_level.glsl"
#include "methods/deep-screen-space/splatting/accepted.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer Stored { uint stored, made; };

uniform usampler2DArray places;
uniform sampler2D gbuffer_position;
uniform sampler2DArray directions;
uniform sampler2D gbuffer_geometric_normal;
uniform usampler2DArray winners;

uniform uint seed;
uniform int levels, samples;
uniform ivec2 hierarchy_size;

ivec2 place_of(ivec2 pixel, int level) { return unpacked_place(texelFetch(places, ivec3(pixel, level), 0).x); }

/// Pixels, on a level, of the sphere in which the surfel is drawn there.
PixelRange splat_range(Surfel s, int level) {
    Shell shell = shell_of(s, level);
    if (shell.inner >= shell.outer || s.radius == 0.0) return NO_PIXELS;
    PixelRange range = pixels_of_sphere(s.centre_ws, shell.outer);
    return PixelRange(range.first >> level, range.last >> level);
}

bool is_in_sub_image(Surfel s, int level, int sample_index, ivec2 place) {
    uvec2 sub_image = random_sub_image(s, uint(level), uint(sample_index), seed);
    return uvec2(place) / (uvec2(hierarchy_size) >> level) == sub_image;
}

bool is_in_range(PixelRange range, ivec2 pixel, int level) {
    ivec2 at = pixel >> level;
    return all(greaterThanEqual(at, range.first)) && all(lessThanEqual(at, range.last));
}

struct ExplainedSplat {
    int shell;
    SplatHit hit;
};

ExplainedSplat explained_splat(Surfel s, int level, ivec2 pixel, int sample_index, vec3 x_ws, vec3 direction_ws,
                               vec3 geometric_normal_ws) {
    SplatLevel l = splat_level(level, s);
    ExplainedSplat e = ExplainedSplat(splat_shell(l, x_ws, s.centre_ws), SplatHit(SPLAT_OUTSIDE, 0.0, 1.0, 0.0));
    if (e.shell < 0) return e;
    e.hit = splat_hit(l, e.shell, x_ws, direction_ws, s.centre_ws, s.normal_ws, s.radius);
    if (e.hit.outcome == SPLAT_HIT &&
        !splat_is_accepted(s, e.hit, pixel, sample_index, x_ws, direction_ws, geometric_normal_ws))
        e.hit.outcome = SPLAT_REFUSED;
    return e;
}
