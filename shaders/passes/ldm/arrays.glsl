// Contiguous sorted arrays. rows: first depth of each row of texels; offsets: of each texel of a row, and of
// the row's end, from there (16 bits, two per word, or 32 bits where LDM_WIDE); depths: 16 bits, two per word, or
// with LDM_SLOPES depth << 16 | codes of slopes.
layout(std430) readonly buffer LdmRows { uint rows[]; };
layout(std430) readonly buffer LdmOffsets { uint offsets[]; };
layout(std430) readonly buffer LdmDepths { uint depths[]; };

#ifdef LDM_SLOPES
int depth_at(uint index) { return int(depths[index] >> 16); }
uint slopes_at(uint index) { return depths[index] & 0xffffu; }
#else
int depth_at(uint index) {
    return int(bitfieldExtract(depths[index >> 1], int(index & 1u) << 4, 16));
}
#endif

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
