// Gives each place of each level the surface of the pixel that stands there, or (COLOURS) its colour, for people to
// look at.  [Nalbach15 §4.1]
layout(local_size_x = 8, local_size_y = 8) in;

#include "methods/deep-screen-space/splatting/places.glsl"

uniform usampler2DArray layout_texture;
#if COLOURS
uniform sampler2D gbuffer_albedo;
uniform writeonly image2DArray colours;

void shuffle(ivec3 place, uint word) {
    vec4 colour = vec4(0);
    if (word != PADDING) colour = vec4(texelFetch(gbuffer_albedo, unpacked_place(word), 0).xyz, 1);
    imageStore(colours, place, colour);
}
#else
uniform sampler2D gbuffer_position;
uniform sampler2D gbuffer_normal;
uniform writeonly image2DArray shuffled_positions;
uniform writeonly image2DArray shuffled_normals;

void shuffle(ivec3 place, uint word) {
    vec4 position = vec4(0), normal = vec4(0);
    if (word != PADDING) {
        position = texelFetch(gbuffer_position, unpacked_place(word), 0);
        position.w = position.w > 0.0 ? 1.0 : 0.0;
        // Half floats are not quite of unit length.
        normal = vec4(texelFetch(gbuffer_normal, unpacked_place(word), 0).xyz, 0);
        if (dot(normal, normal) > 0.0) normal = normalize(normal);
    }
    imageStore(shuffled_positions, place, position);
    imageStore(shuffled_normals, place, normal);
}
#endif

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(place, textureSize(layout_texture, 0)))) return;
    shuffle(place, texelFetch(layout_texture, place, 0).x);
}
