// A level of the Haar pyramid from the scaling coefficients below it, or from the map itself.
layout(local_size_x = 8, local_size_y = 8) in;
#include "methods/photon-mapping/emission/haar.glsl"

uniform sampler2DArray below;
layout(rgba32f) uniform writeonly image2DArray level;

uniform int level_below;  // mip level of `below`
uniform int size;         // texels a side that are written

void main() {
    ivec3 place = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(place.xy, ivec2(size)))) return;
    ivec3 corner = ivec3(2 * place.xy, place.z);
    imageStore(level, place,
               haar_step(vec4(texelFetch(below, corner, level_below).r,
                              texelFetch(below, corner + ivec3(1, 0, 0), level_below).r,
                              texelFetch(below, corner + ivec3(0, 1, 0), level_below).r,
                              texelFetch(below, corner + ivec3(1, 1, 0), level_below).r)));
}
