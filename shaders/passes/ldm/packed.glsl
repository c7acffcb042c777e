// Contiguous sorted arrays of depths of LDM_PACKED_BITS bits, without gaps. rows: first depth of each row of texels;
// groups: packed_groups.glsl.
layout(std430, binding = LDM_STORAGE) readonly buffer LdmPackedRows { uint rows[]; };
layout(std430, binding = LDM_STORAGE + 1) readonly buffer LdmGroups { uint groups[]; };
layout(std430, binding = LDM_STORAGE + 2) readonly buffer LdmPackedDepths { uint depths[]; };
#include "passes/ldm/packed_depth.glsl"
#include "passes/ldm/packed_groups.glsl"

int depth_at(uint index) {
    uvec2 place = packed_place(index);
    uint bits = depths[place.x] >> place.y;
    if (place.y + uint(PACKED_BITS) > 32u) bits |= depths[place.x + 1u] << (32u - place.y);
    return int(unpacked_depth(bits & ((1u << PACKED_BITS) - 1u)));
}

/// Places of the texel's first depth and of the one after its last.
uvec2 depth_range(uint map, ivec2 texel, int resolution) {
#ifdef LDM_EMPTY
    return uvec2(0u);
#endif
    uint row = map * uint(resolution) + uint(texel.y), t = uint(texel.x) % GROUP_TEXELS;
    uint group = GROUP_WORDS * (row * groups_of_row(uint(resolution)) + uint(texel.x) / GROUP_TEXELS);
    uvec2 words = uvec2(groups[group], groups[group + 1u]), range;
    if ((words.x & 0xffffu) == WIDE_GROUP)
        range = uvec2(groups[words.y + t], groups[words.y + t + 1u]);
    else
        range = group_range(words, t);
    return rows[row] + range;
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
