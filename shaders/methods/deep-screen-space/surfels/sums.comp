// Sums over fine surfels (FINE) or those that are kept: of areas and of parts of the ideal area. Each work group
// adds the surfels of its share, one group the sums of all: in the same order in every run.
layout(local_size_x = 256) in;
#include "lib/constants.glsl"
#include "methods/deep-screen-space/surfels/ideal.glsl"
#if FINE
#include "methods/deep-screen-space/surfels/fine.glsl"
#else
#include "methods/deep-screen-space/records.glsl"
layout(std430) readonly buffer Surfels { Surfel surfels[]; };
#endif
#if FINE
layout(std430) readonly buffer Count { uint count; };
#else
layout(std430) readonly buffer Stored { uint count, made; };
#endif
layout(std430) writeonly buffer Sums { vec2 sums[]; };

uniform uint capacity;

shared vec2 of_invocation[256];

vec2 at(uint item) {
#if FINE
    FineSurfel s = fine_surfel(item);
    return vec2(fine_area_of(s), s.part);
#else
    float area = PI * surfels[item].radius * surfels[item].radius;
    return vec2(area, area / ideal_area(surfels[item].centre_ws));
#endif
}

void main() {
    uint me = gl_LocalInvocationID.x, there = min(count, capacity), stride = 256u * gl_NumWorkGroups.x;
    vec2 sum = vec2(0);
    for (uint item = gl_WorkGroupID.x * 256u + me; item < there; item += stride) sum += at(item);
    of_invocation[me] = sum;
    barrier();
    for (uint half_size = 128u; half_size > 0u; half_size /= 2u) {
        if (me < half_size) of_invocation[me] += of_invocation[me + half_size];
        barrier();
    }
    if (me == 0u) sums[gl_WorkGroupID.x] = of_invocation[0];
}
