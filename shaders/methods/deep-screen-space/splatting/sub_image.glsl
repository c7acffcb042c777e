// Which sub-image of a level a surfel is splatted into. [Nalbach15 §4.1]
#include "lib/random.glsl"

uniform bool stratified_sub_images;

/// Column and row. Stratified, surfels that follow each other take all sub-images in turn: where order is nearness,
/// each sub-image has its share of every surface.
/// DEVIATION [Nalbach15 §4.1]: drawn independently, sub-images have more of one surface and less of another.
uvec2 random_sub_image(Surfel surfel, uint level, uint sample_index, uint seed) {
    if (stratified_sub_images) {
        uint offset = pcg4d(uvec4(0u, level, sample_index, seed)).x;
        uint number = surfel.order + offset & (1u << 2u * level) - 1u;
        return uvec2(number & (1u << level) - 1u, number >> level);
    }
    uvec2 random = pcg4d(uvec4(surfel.identity, level, sample_index, seed)).xy;
    return (random >> 16) << level >> 16;
}
