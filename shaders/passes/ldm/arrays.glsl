// Contiguous sorted arrays. rows: first depth of each row of texels; offsets: of each texel of a row, and of
// the row's end, from there (16 bits, two per word, or 32 bits where LDM_WIDE); depths: 16 bits, two per word.
layout(std430, binding = LDM_STORAGE) readonly buffer LdmRows { uint rows[]; };
layout(std430, binding = LDM_STORAGE + 1) readonly buffer LdmOffsets { uint offsets[]; };
layout(std430, binding = LDM_STORAGE + 2) readonly buffer LdmDepths { uint depths[]; };

int depth_at(uint index) {
    return int(bitfieldExtract(depths[index >> 1], int(index & 1u) << 4, 16));
}

/// Places of the texel's first depth and of the one after its last.
uvec2 depth_range(uint map, ivec2 texel, int resolution) {
#ifdef LDM_EMPTY
    return uvec2(0u);
#endif
    uint row = map * uint(resolution) + uint(texel.y);
    uint base = rows[row];
    uint offset = row * (uint(resolution + 2) & ~1u) + uint(texel.x);
#ifdef LDM_WIDE
    return base + uvec2(offsets[offset], offsets[offset + 1u]);
#else
    uint word = offsets[offset >> 1];
    uint begin = (offset & 1u) == 0u ? word & 0xffffu : word >> 16;
    uint end = (offset & 1u) == 0u ? word >> 16 : offsets[(offset >> 1) + 1u] & 0xffffu;
    return base + uvec2(begin, end);
#endif
}

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    uvec2 range = depth_range(map, texel, resolution);
    while (range.x < range.y) {
        uint middle = (range.x + range.y) >> 1;
        int found = depth_at(middle);
        if (found < depth) {
            result.before = found;
            range.x = middle + 1u;
        } else {
            result.behind = found;
            range.y = middle;
        }
    }
    return result;
}

LdmNeighbours ldm_any(uint map, ivec2 texel, int resolution, int depth, bool behind) {
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    uvec2 range = depth_range(map, texel, resolution);
    if (range.x >= range.y) return result;
    int outermost = depth_at(behind ? range.y - 1u : range.x);
    if (outermost < depth)
        result.before = outermost;
    else
        result.behind = outermost;
    return result;
}

LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    uvec2 range = depth_range(map, texel, resolution);
    return LdmCursor(range.x, range.y);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at < cursor.end; }
int ldm_depth(LdmCursor cursor) { return depth_at(cursor.at); }
LdmCursor ldm_next(LdmCursor cursor) { return LdmCursor(cursor.at + 1u, cursor.end); }
