// Sorted arrays of LDM_FIXED_LAYERS depths per texel, of 16 bits, two per word; 65535 where there is none.
layout(std430) readonly buffer LdmFixedDepths { uint fixed_depths[]; };

const int FIXED_NONE = 65535;

int fixed_depth(uint index) {
    return int(bitfieldExtract(fixed_depths[index >> 1], int(index & 1u) << 4, 16));
}

/// Place of the texel's first depth.
uint fixed_first(uint map, ivec2 texel, int resolution) {
    uint side = uint(resolution);
    return ((map * side + uint(texel.y)) * side + uint(texel.x)) * ((LDM_FIXED_LAYERS + 1u) & ~1u);
}

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    uint low = fixed_first(map, texel, resolution), high = low + LDM_FIXED_LAYERS;
    while (low < high) {
        uint middle = (low + high) >> 1;
        int found = fixed_depth(middle);
        if (found < min(depth, FIXED_NONE)) {
            result.before = found;
            low = middle + 1u;
        } else {
            if (found != FIXED_NONE) result.behind = found;
            high = middle;
        }
    }
    return result;
}

LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    uint first = fixed_first(map, texel, resolution);
    return LdmCursor(first, first + LDM_FIXED_LAYERS);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at < cursor.end && fixed_depth(cursor.at) != FIXED_NONE; }
int ldm_depth(LdmCursor cursor) { return fixed_depth(cursor.at); }
LdmCursor ldm_next(LdmCursor cursor) { return LdmCursor(cursor.at + 1u, cursor.end); }
