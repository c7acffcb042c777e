// Questions to storages that are contiguous sorted arrays: they define depth_range and depth_at.

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

#ifdef LDM_SLOPES
/// The nearest node along ±v, from the test's key on, that lies before x by its slopes, too: LDM_NONE_… where there is
/// none.
int ldm_next_by_slopes(uint map, ivec2 texel, int resolution, LdmSlopeTest test) {
    uvec2 range = depth_range(map, texel, resolution), all = range;
    while (range.x < range.y) {
        uint middle = (range.x + range.y) >> 1;
        if (depth_at(middle) < test.key)
            range.x = middle + 1u;
        else
            range.y = middle;
    }
    uint count = test.forward ? all.y - range.x : range.x - all.x;
    for (uint i = 0u; i < count; ++i) {
        uint place = test.forward ? range.x + i : range.x - 1u - i;
        int depth = depth_at(place);
        if (ldm_lies_before(test, depth, slopes_at(place))) return depth;
    }
    return test.forward ? LDM_NONE_BEHIND : LDM_NONE_BEFORE;
}
#endif

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
