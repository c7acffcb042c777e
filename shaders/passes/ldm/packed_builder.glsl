// What the steps of packing a chunk share, whose sorted depths are in arrays (array_builder.glsl with ONE_CHUNK).
#include "passes/ldm/chunk.glsl"
#include "passes/ldm/packed_depth.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"
#include "passes/ldm/packed_groups.glsl"

/// The chunk's sorted nodes, as in array_builder.glsl; a texel's begin at counts[texel].
layout(std430) readonly buffer LdmDepths { uint sorted_depths[]; };
/// Per texel of the chunk: first the number of its packed depths, then where they begin, in the batch.
layout(std430) buffer LdmPackedTexels { uint packed_texels[]; };
layout(std430) buffer LdmPackedRows { uint rows[]; };
layout(std430) buffer LdmGroups { uint groups[]; };
layout(std430) coherent buffer LdmPackedDepths { uint depths[]; };

uniform uint table_words;  // of the batch, without those of wide groups
uniform uint depth_words;  // of packed depths that there is room for

/// Depths that there is room for.
uint packed_room() {
    uint bits = uint(NODE_BITS);
    return depth_words / bits * BLOCK_DEPTHS + depth_words % bits * 32u / bits;
}

bool has_sorted(uint texel) {
#ifdef LDM_SLOPES
    return counts[texel + 1u] <= uint(sorted_depths.length());
#else
    return counts[texel + 1u] <= 2u * uint(sorted_depths.length());
#endif
}

/// The chunk's node number `index`, packed.
uint sorted_at(uint index) {
#ifdef LDM_SLOPES
    uint node = sorted_depths[index];
    return packed_depth(node >> 16) << 16 | (node & 0xffffu);
#else
    return packed_depth(bitfieldExtract(sorted_depths[index >> 1], int(index & 1u) << 4, 16));
#endif
}
