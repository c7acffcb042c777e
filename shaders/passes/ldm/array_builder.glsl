// What the steps of building arrays share. A chunk's texels count from 0; its rows lie from first_row on in the
// batch.
#include "passes/ldm/builder.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"

layout(std430, binding = 13) buffer LdmRows { uint rows[]; };
layout(std430, binding = 14) buffer LdmOffsets { uint offsets[]; };
layout(std430, binding = 15) coherent buffer LdmDepths { uint depths[]; };
/// The chunk's depths, texel by texel.
layout(std430, binding = 8) buffer LdmUnsorted { uint unsorted[]; };

uniform uint first_row, row_count;
uniform uint resolution;

/// Writes one half of a word that another invocation may write the other half of.
void store_half(uint index, uint depth) {
    int shift = int(index & 1u) << 4;
    atomicAnd(depths[index >> 1], ~(0xffffu << shift));
    atomicOr(depths[index >> 1], depth << shift);
}
