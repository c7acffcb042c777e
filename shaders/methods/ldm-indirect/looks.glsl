// How far each pixel sees towards where photons come from, by each map along its direction: a look. Of a look 8 bits
// are kept, 16 steps to an octave, rounded down; the unit is 1/65,536 of the diagonal of the scene's bounds.
// renderers/methods/ldm-indirect/looks.h does the same on the host.

/// Beyond which nothing is in the way.
// C++: ir::methods::ldm_indirect::open_look
const uint OPEN_LOOK = 255u;
/// Of a look's bits, with 4 bits of the mantissa.
// C++: ir::methods::ldm_indirect::look_shift
const uint LOOK_SHIFT = 19u;
/// The bits of 1 so shifted: no look is shorter.
// C++: ir::methods::ldm_indirect::shortest_look
const uint SHORTEST_LOOK = 2032u;

uint packed_look(float units) {
    return min((floatBitsToUint(max(units, 1.0)) >> LOOK_SHIFT) - SHORTEST_LOOK, OPEN_LOOK);
}
float unpacked_look(uint look) { return uintBitsToFloat((look + SHORTEST_LOOK) << LOOK_SHIFT); }

/// Looks stand by tile of so many pixels a side, then by map, then row by row: four pixels to a word.
// C++: ir::methods::ldm_indirect::look_tile
const uint LOOK_TILE = 8u;

/// Where the word with a pixel's look stands.
uint look_word(uvec2 pixel, uint width, uint maps, uint map) {
    uvec2 tile = pixel / LOOK_TILE, at = pixel % LOOK_TILE;
    uint tiles_across = (width + LOOK_TILE - 1u) / LOOK_TILE;
    return (((tile.y * tiles_across + tile.x) * maps + map) * LOOK_TILE + at.y) * (LOOK_TILE / 4u) + at.x / 4u;
}
/// Where in the word it stands.
int look_bit(uvec2 pixel) { return int(8u * (pixel.x % 4u)); }
