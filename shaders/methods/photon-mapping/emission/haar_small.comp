// The last levels of the Haar pyramid, from 32 texels a side or fewer down to 1, in shared memory. One work
// group: one layer.  [Smal19 §5.3.1.2]
layout(local_size_x = 16, local_size_y = 16) in;
#include "methods/photon-mapping/emission/haar.glsl"

uniform sampler2DArray below;
layout(rgba32f) uniform writeonly image2DArray level0;
layout(rgba32f) uniform writeonly image2DArray level1;
layout(rgba32f) uniform writeonly image2DArray level2;
layout(rgba32f) uniform writeonly image2DArray level3;
layout(rgba32f) uniform writeonly image2DArray level4;

uniform int level_below, size_below;  // a power of two, at most 32

shared float scaling[32][32];

void store(int step, ivec3 place, vec4 coefficients) {
    if (step == 0) imageStore(level0, place, coefficients);
    if (step == 1) imageStore(level1, place, coefficients);
    if (step == 2) imageStore(level2, place, coefficients);
    if (step == 3) imageStore(level3, place, coefficients);
    if (step == 4) imageStore(level4, place, coefficients);
}

void main() {
    ivec2 me = ivec2(gl_LocalInvocationID.xy);
    int layer = int(gl_WorkGroupID.z);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = me + 16 * ivec2(i & 1, i >> 1);
        if (all(lessThan(texel, ivec2(size_below))))
            scaling[texel.y][texel.x] = texelFetch(below, ivec3(texel, layer), level_below).r;
    }
    int step = 0;
    for (int size = size_below / 2; size > 0; size /= 2) {
        barrier();
        bool active_here = all(lessThan(me, ivec2(size)));
        vec4 coefficients = vec4(0);
        if (active_here)
            coefficients = haar_step(vec4(scaling[2 * me.y][2 * me.x], scaling[2 * me.y][2 * me.x + 1],
                                          scaling[2 * me.y + 1][2 * me.x], scaling[2 * me.y + 1][2 * me.x + 1]));
        barrier();
        if (active_here) {
            scaling[me.y][me.x] = coefficients.x;
            store(step, ivec3(me, layer), coefficients);
        }
        ++step;
    }
}
