// A hash table of all texels' depths. ages: each texel's largest age; cells: age << 16 | 65535 - depth, 0 where there
// is none. An older entry in a cell belongs to another texel, and a younger one ends the search: an entry that is older
// still would have taken the cell.
#include "passes/ldm/hash_cells.glsl"
layout(std430) readonly buffer LdmAges { uint hash_ages[]; };
layout(std430) readonly buffer LdmCells { uint hash_cells[]; };

const int HASH_OTHER = -1, HASH_END = LDM_NONE_BEHIND;

uint hash_texel_of(uint map, ivec2 texel, int resolution) {
    uint side = uint(resolution);
    return (map * side + uint(texel.y)) * side + uint(texel.x);
}

uint hash_max_age(uint texel) {
#ifdef LDM_EMPTY
    return 0u;
#else
    return hash_ages[texel];
#endif
}

/// Depth of the texel's entry of this age, or HASH_OTHER, or HASH_END where there are none from that age on.
int hash_depth(uint texel, uint age) {
    uint entry = hash_cells[hash_cell(texel, age, uint(hash_cells.length()))];
    uint found = entry >> 16;
    return found == age ? int(65535u - (entry & 0xffffu)) : found > age ? HASH_OTHER : HASH_END;
}

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    uint index = hash_texel_of(map, texel, resolution);
    uint low = 1u, high = hash_max_age(index) + 1u;
    while (low < high) {
        uint middle = (low + high) >> 1, age = middle;
        int found = hash_depth(index, age);
        while (found == HASH_OTHER && ++age < high) found = hash_depth(index, age);
        if (found == HASH_OTHER) {
            high = middle;
        } else if (found < depth) {
            result.before = found;
            low = age + 1u;
        } else {
            result.behind = found;
            high = middle;
        }
    }
    return result;
}

LdmCursor hash_next(uint texel, uint age) {
    uint most = hash_max_age(texel);
    for (; age <= most; ++age) {
        int found = hash_depth(texel, age);
        if (found == HASH_END) break;
        if (found != HASH_OTHER) return LdmCursor(age, texel);
    }
    return LdmCursor(0u, texel);
}

/// `at`: age, 0 at the end; `end`: the texel.
LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    return hash_next(hash_texel_of(map, texel, resolution), 1u);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at != 0u; }
int ldm_depth(LdmCursor cursor) { return hash_depth(cursor.end, cursor.at); }
LdmCursor ldm_next(LdmCursor cursor) { return hash_next(cursor.end, cursor.at + 1u); }
