// Contiguous sorted arrays of nodes of NODE_BITS bits, without gaps. rows: first depth of each row of texels;
// groups: packed_groups.glsl.
layout(std430) readonly buffer LdmPackedRows { uint rows[]; };
layout(std430) readonly buffer LdmGroups { uint groups[]; };
layout(std430) readonly buffer LdmPackedDepths { uint depths[]; };
#include "passes/ldm/packed_depth.glsl"
#include "passes/ldm/packed_groups.glsl"

uint node_at(uint index) {
    uvec2 place = packed_place(index);
    uint bits = depths[place.x] >> place.y;
    if (place.y + uint(NODE_BITS) > 32u) bits |= depths[place.x + 1u] << (32u - place.y);
    return bits & ((1u << NODE_BITS) - 1u);
}
int depth_at(uint index) { return int(unpacked_depth(node_at(index) >> (NODE_BITS - PACKED_BITS))); }
#ifdef LDM_SLOPES
uint slopes_at(uint index) { return node_at(index) & 0xffffu; }
#endif

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
