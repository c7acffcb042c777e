// Lookup tables of the hierarchical framebuffer: for each pixel of the padded view its place on each level, and
// back.  [Nalbach15 fig. 5]
layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly uimage2DArray layout_image;
uniform writeonly uimage2DArray places_image;

#include "lib/random.glsl"
#include "methods/deep-screen-space/splatting/places.glsl"

uniform ivec2 view_size;
uniform uint seed;

/// One of the 24 permutations of 0 … 3, applied to `digit`.
uint permuted(uint digit, uint which) {
    uint order[4] = uint[](0u, 1u, 2u, 3u);
    for (uint i = 3u; i > 0u; --i) {
        uint other = which % (i + 1u), kept = order[i];
        which /= i + 1u;
        order[i] = order[other];
        order[other] = kept;
    }
    return order[digit];
}

/// Column and row of the sub-image of `level` that gets this pixel. A quadtree of random permutations of four, one for
/// each node, so that every pixel is as likely in every sub-image, and neighbourhoods choose independently.
/// [Nalbach15 §4.1, fig. 5]
uvec2 sub_image_of(uvec2 pixel, uint level, uint seed) {
    uvec2 sub_image = uvec2(0);
    for (uint depth = 0u; depth < level; ++depth) {
        uvec2 node = pixel >> (level - depth), bits = (pixel >> (level - depth - 1u)) & 1u;
        // The hash's lower bits are related to those of other nodes: χ² shows it.
        uint random = (pcg4d(uvec4(node, level | depth << 8, seed)).x >> 16) * 24u >> 16;
        uint digit = permuted(bits.x | bits.y << 1, random);
        sub_image = sub_image << 1 | uvec2(digit & 1u, digit >> 1);
    }
    return sub_image;
}

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
