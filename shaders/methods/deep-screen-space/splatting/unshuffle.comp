// Takes one layer of a stack of places back to the pixels of the view.
layout(local_size_x = 8, local_size_y = 8) in;

#include "methods/deep-screen-space/splatting/places.glsl"

uniform usampler2DArray places_texture;
uniform sampler2DArray stack;
#ifdef TO_STACK
uniform writeonly image2DArray result;
#else
uniform writeonly image2D result;
#endif

uniform int level;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(result).xy))) return;
    ivec2 place = unpacked_place(texelFetch(places_texture, ivec3(pixel, level), 0).x);
    vec4 value = texelFetch(stack, ivec3(place, level), 0);
#ifdef TO_STACK
    imageStore(result, ivec3(pixel, level), value);
#else
    imageStore(result, pixel, value);
#endif
}
