// Contiguous sorted arrays of depths of LDM_PACKED_BITS bits, without gaps. rows: first depth of each row of texels;
// groups: packed_groups.glsl.
layout(std430) readonly buffer LdmPackedRows { uint rows[]; };
layout(std430) readonly buffer LdmGroups { uint groups[]; };
layout(std430) readonly buffer LdmPackedDepths { uint depths[]; };
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
