// The Haar pyramid as one picture: details of each level in three quadrants, the next level in the fourth.
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2DArray haar_pyramid;
layout(r32f) uniform writeonly image2D quadrants;

uniform int layer;

void main() {
    ivec2 place = ivec2(gl_GlobalInvocationID.xy);
    int size = imageSize(quadrants).x;
    if (any(greaterThanEqual(place, ivec2(size)))) return;
    int level = 0, channel = 0;
    ivec2 cell = ivec2(0);
    // no turn ends early: llvmpipe gave neighbours wrong results after searches that did
    for (int i = 0, half_size = size / 2; half_size > 0; ++i, half_size /= 2) {
        bvec2 beyond = greaterThanEqual(place, ivec2(half_size));
        bool is_here = channel == 0 && any(beyond);
        if (is_here) {
            channel = (beyond.x ? 1 : 0) + (beyond.y ? 2 : 0);
            level = i;
            cell = place - half_size * ivec2(beyond);
        }
        if (channel == 0) level = i;
    }
    imageStore(quadrants, place, vec4(texelFetch(haar_pyramid, ivec3(cell, layer), level)[channel]));
}
