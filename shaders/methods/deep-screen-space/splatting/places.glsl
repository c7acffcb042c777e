// Pixels and places as "hierarchy.layout" and "hierarchy.places" hold them.

const uint PADDING = 0xffffffffu;

uint packed_place(uvec2 place) { return place.x | place.y << 16; }
ivec2 unpacked_place(uint packed) { return ivec2(packed & 0xffffu, packed >> 16); }
