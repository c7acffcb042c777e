// What fragments of splats know: where they are, what is there, and by which surfel they are affected.
// renderers/methods/deep-screen-space/splatting/splats.h (bind_receivers) binds the textures.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"

layout(binding = 5) uniform usampler2DArray layout_texture;
layout(binding = 6) uniform sampler2DArray position_stack;
layout(binding = 7) uniform sampler2DArray normal_stack;

layout(std430, binding = 10) readonly buffer Surfels { Surfel surfels[]; };

uniform int level, sample_index;

layout(location = 0) flat in uint surfel_index;

ivec3 own_place() { return ivec3(ivec2(gl_FragCoord.xy), level); }

/// Of the view; only where there is a surface.
ivec2 own_pixel() { return unpacked_place(texelFetch(layout_texture, own_place(), 0).x); }

/// World space; w 0: no surface.
vec4 own_position() { return texelFetch(position_stack, own_place(), 0); }

/// Shading normal.
vec3 own_normal() { return texelFetch(normal_stack, own_place(), 0).xyz; }
