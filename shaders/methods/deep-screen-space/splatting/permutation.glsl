// Which sub-image a pixel of a neighbourhood goes to: a quadtree of random permutations of four, one for each
// node, so that every pixel is as likely in every sub-image, and neighbourhoods choose independently.
// [Nalbach15 §4.1, fig. 5]
#include "lib/random.glsl"

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

/// Column and row of the sub-image of `level` that gets this pixel.
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
