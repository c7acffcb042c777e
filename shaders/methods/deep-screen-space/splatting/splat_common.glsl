// What fragments of splats know: where they are, what is there, and by which surfel they are affected.
// Constants: SplatConstants of renderers/methods/deep-screen-space/splatting/splats.h.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"

uniform usampler2DArray layout_texture;
uniform sampler2DArray shuffled_positions;
uniform sampler2DArray shuffled_normals;

layout(std430) readonly buffer Surfels { Surfel surfels[]; };

uniform int level, sample_index;

layout(location = 0) flat in uint surfel_index;

ivec3 own_place() { return ivec3(ivec2(gl_FragCoord.xy), level); }

/// Of the view; only where there is a surface.
ivec2 own_pixel() { return unpacked_place(texelFetch(layout_texture, own_place(), 0).x); }

/// World space; w 0: no surface.
vec4 own_position() { return texelFetch(shuffled_positions, own_place(), 0); }

/// Shading normal.
vec3 own_normal() { return texelFetch(shuffled_normals, own_place(), 0).xyz; }
