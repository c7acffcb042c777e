// The outermost two depths of each texel: largest << 16 | largest of 65535 - depth; 0 where there is no surface.
layout(std430) readonly buffer LdmOutermost { uint outermost[]; };

/// Least and largest depth; the least is the larger one where there is none.
ivec2 outermost_depths(uint map, ivec2 texel, int resolution) {
    uint side = uint(resolution);
    uint word = outermost[(map * side + uint(texel.y)) * side + uint(texel.x)];
    return ivec2(65535 - int(word & 0xffffu), int(word >> 16));
}

LdmNeighbours ldm_neighbours(uint map, ivec2 texel, int resolution, int depth) {
    ivec2 depths = outermost_depths(map, texel, resolution);
    LdmNeighbours result = LdmNeighbours(LDM_NONE_BEFORE, LDM_NONE_BEHIND);
    if (depths.x > depths.y) return result;
    if (depths.x < depth) result.before = depths.y < depth ? depths.y : depths.x;
    if (depths.y >= depth) result.behind = depths.x >= depth ? depths.x : depths.y;
    return result;
}

// A cursor holds depths instead of places.
LdmCursor ldm_first(uint map, ivec2 texel, int resolution) {
    uvec2 depths = uvec2(outermost_depths(map, texel, resolution));
    return LdmCursor(depths.x, depths.y);
}
bool ldm_valid(LdmCursor cursor) { return cursor.at <= cursor.end; }
int ldm_depth(LdmCursor cursor) { return int(cursor.at); }
LdmCursor ldm_next(LdmCursor cursor) {
    return LdmCursor(cursor.at == cursor.end ? cursor.end + 1u : cursor.end, cursor.end);
}
