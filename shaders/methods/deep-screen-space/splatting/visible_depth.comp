// Bounced z of every level where the pixels are.
layout(local_size_x = 8, local_size_y = 8) in;

#include "methods/deep-screen-space/splatting/places.glsl"

uniform usampler2DArray places;
uniform sampler2DArray depths;
layout(r32f) uniform writeonly image2DArray depth_image;

uniform int levels;

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, imageSize(depth_image)))) return;
    ivec2 place = unpacked_place(texelFetch(places, ivec3(at.xy, at.z % levels), 0).x);
    imageStore(depth_image, at, texelFetch(depths, ivec3(place, at.z), 0).xxxx);
}
