// The picture's colours at their places on each level, for people to look at.
layout(local_size_x = 8, local_size_y = 8) in;

#include "methods/deep-screen-space/splatting/places.glsl"

uniform usampler2DArray layout_texture;
uniform sampler2D gbuffer_albedo;
uniform writeonly image2DArray colours;

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(place, textureSize(layout_texture, 0)))) return;
    uint word = texelFetch(layout_texture, place, 0).x;
    vec4 colour = vec4(0);
    if (word != PADDING) colour = vec4(texelFetch(gbuffer_albedo, unpacked_place(word), 0).xyz, 1);
    imageStore(colours, place, colour);
}
