// Lookup tables of the hierarchical framebuffer: for each pixel of the padded view its place on each level, and
// back.  [Nalbach15 fig. 5]
layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly uimage2DArray layout_image;
uniform writeonly uimage2DArray places_image;

#include "methods/deep-screen-space/splatting/permutation.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"

uniform ivec2 view_size;
uniform uint seed;

void main() {
    ivec3 at = ivec3(gl_GlobalInvocationID), size = imageSize(places_image);
    if (any(greaterThanEqual(at, size))) return;
    uint level = uint(at.z);
    uvec2 pixel = uvec2(at.xy), sub_image_size = uvec2(size.xy) >> level;
    uvec2 place = sub_image_of(pixel, level, seed) * sub_image_size + (pixel >> level);
    bool is_seen = all(lessThan(at.xy, view_size));
    imageStore(places_image, at, uvec4(packed_place(place)));
    imageStore(layout_image, ivec3(place, level), uvec4(is_seen ? packed_place(pixel) : PADDING));
}
