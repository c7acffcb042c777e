// What fragments of splats know: where they are, what is there, and by which surfel they are affected.
// renderers/methods/deep-screen-space/splatting/splats.h (bind_receivers) binds the textures.
#include "methods/deep-screen-space/records.glsl"
#include "methods/deep-screen-space/splatting/influence.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"

layout(binding = 0) uniform usampler2DArray layout_texture;
layout(binding = 1) uniform sampler2DArray position_stack;
layout(binding = 2) uniform sampler2DArray normal_stack;

layout(std430, binding = 10) readonly buffer Surfels { Surfel surfels[]; };

uniform int level, sample_index;

layout(location = 0) flat in uint surfel_index;

ivec3 own_place() { return ivec3(ivec2(gl_FragCoord.xy), level); }

/// Of the view; only where a receiver exists.
ivec2 own_pixel() { return unpacked_place(texelFetch(layout_texture, own_place(), 0).x); }

struct Receiver {
    bool exists;
    vec3 position, normal;  // world space; shading normal
};

Receiver own_receiver() {
    vec4 position = texelFetch(position_stack, own_place(), 0);
    return Receiver(position.w > 0.0, position.xyz, texelFetch(normal_stack, own_place(), 0).xyz);
}
