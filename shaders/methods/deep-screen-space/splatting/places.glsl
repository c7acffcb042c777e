// Pixels and places as "hierarchy.layout" and "hierarchy.places" hold them.

// C++: ir::methods::deep_screen_space::padding
const uint PADDING = 0xffffffffu;

uint packed_place(uvec2 place) { return place.x | place.y << 16; }
ivec2 unpacked_place(uint word) { return ivec2(word & 0xffffu, word >> 16); }
