// What the steps of building lists that are sorted after share. Nodes of a chunk's fragment i are at stored + i.
#include "passes/ldm/chunk.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"

/// First node of each texel of the batch, from 1 on; 0: empty.
layout(std430) buffer LdmHeads { uint heads[]; };
/// x: next node, from 1 on, or 0; y: depth.
layout(std430) buffer LdmNodes { uvec2 nodes[]; };
/// Texels of the chunk with more than FEW_LAYERS.
layout(std430) buffer LdmDeepTexels { uint deep_list[]; };
/// Of each fragment of the chunk the node that comes after it in order, and in the top bit whether it is its texel's
/// first; only of the deepest texels.
layout(std430) buffer LdmSuccessors { uint successors[]; };

const uint FEW_LAYERS = 16u;
/// A merge sort takes about 2 n log2 n turns, and drivers may stop loops after 65,535.
const uint MAX_MERGED = 512u;
const uint IS_FIRST = 0x80000000u;
