// Which sub-image of a level a surfel is splatted into. [Nalbach15 §4.1]
#include "lib/random.glsl"

/// Column and row; never of the surfel's place in the buffer, which depends on what else is there.
uvec2 random_sub_image(uint identity, uint level, uint sample_index, uint seed) {
    uvec2 random = pcg4d(uvec4(identity, level, sample_index, seed)).xy;
    return (random >> 16) << level >> 16;
}
