// Where a surfel is splatted, found for one pixel: what rectangles.comp finds for all.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"
#include "methods/deep-screen-space/splatting/sphere_bounds.glsl"
#include "methods/deep-screen-space/splatting/sub_image.glsl"

layout(std430) readonly buffer Surfels { Surfel surfels[]; };
layout(std430) readonly buffer Stored { uint stored, made; };

uniform usampler2DArray places;

uniform uint seed;
uniform int levels;
uniform ivec2 hierarchy_size;

ivec2 place_of(ivec2 pixel, int level) { return unpacked_place(texelFetch(places, ivec3(pixel, level), 0).x); }

/// Pixels, on a level, of the sphere in which the surfel is drawn there.
PixelRange splat_range(Surfel s, int level) {
    Shell shell = shell_of(s.radius, level);
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
