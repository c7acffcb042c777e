// How far each pixel sees towards where photons come from, by each map along its direction: a look, of four of which
// a word consists. Of a look 8 bits are kept, 16 to an octave, rounded down; the unit is 1/65,536 of the diagonal of the
// scene's bounds. renderers/methods/ldm-indirect/looks.h does the same on the host.

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

/// Where the word with a map's look stands.
uint look_word(ivec2 pixel, ivec2 size, uint map) {
    return (map / 4u * uint(size.y) + uint(pixel.y)) * uint(size.x) + uint(pixel.x);
}
