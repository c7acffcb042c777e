// What the steps of building arrays share. A chunk's texels count from 0; its rows lie from first_row on in the
// batch.
#include "passes/ldm/chunk.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"

/// Nodes in their order: two depths of 16 bits a word, or one depth << 16 | codes of slopes.
layout(std430) coherent buffer LdmDepths { uint depths[]; };
/// The chunk's nodes, texel by texel; a depth has a word here, too.
layout(std430) buffer LdmUnsorted { uint unsorted[]; };

/// Texels of the chunk with more than FEW_LAYERS.
layout(std430) buffer LdmDeepTexels { uint deep_list[]; };

const uint FEW_LAYERS = 16u;
/// Insertion takes up to n²/2 turns, and drivers may stop loops after 65,535.
const uint MAX_INSERTED = 192u;

/// Depths of the batch before the chunk's, and what it would hold then if every buffer were large enough.
#ifdef ONE_CHUNK
const uint stored_before = 0u, requested_before = 0u;
#else
#define stored_before stored
#define requested_before requested
#endif

#ifdef LDM_SLOPES
const uint NODES_PER_WORD = 1u;
uint node_of(LdmFragment fragment) { return fragment.arrival_depth << 16 | fragment.slopes; }
#else
const uint NODES_PER_WORD = 2u;
uint node_of(LdmFragment fragment) { return fragment.arrival_depth & 0xffffu; }
#endif
/// Comes after all nodes.
const uint NO_NODE = 0xffffffffu;

/// Nodes that there is room for, in programs that use the nodes themselves (of others see array_table.glsl).
uint node_room() { return NODES_PER_WORD * uint(depths.length()); }

/// Writes one half of a word that another invocation may write the other half of.
void store_half(uint index, uint depth) {
    int shift = int(index & 1u) << 4;
    atomicAnd(depths[index >> 1], ~(0xffffu << shift));
    atomicOr(depths[index >> 1], depth << shift);
}

/// Stores two depths in a word, if the texel owns both halves; it owns halves begin … end - 1.
void store_pair(uint word, uint low, uint high, uint begin, uint end) {
    if (2u * word >= begin && 2u * word + 1u < end) depths[word] = low | high << 16;
}

/// Stores what store_pair leaves: halves of words that are shared with other texels.
void store_ends(uint least, uint most, uint begin, uint end) {
    if ((begin & 1u) != 0u) store_half(begin, least);
    if ((end & 1u) != 0u) store_half(end - 1u, most);
}

/// Stores COUNT sorted nodes v[0] … of the including function, of which the texel owns places begin … end - 1; `most`
/// is the last one.
#ifdef LDM_SLOPES
#define STORE_SORTED(COUNT) \
    for (int i = 0; i < COUNT; ++i) \
        if (begin + uint(i) < end) depths[begin + uint(i)] = v[i];
#else
#define STORE_SORTED(COUNT) \
    bool odd = (begin & 1u) != 0u; \
    uint word = begin >> 1; \
    store_pair(word, v[0], v[1], begin, end); \
    for (int i = 1; i < COUNT / 2; ++i) \
        store_pair(word + uint(i), odd ? v[2 * i - 1] : v[2 * i], odd ? v[2 * i] : v[2 * i + 1], begin, end); \
    store_ends(v[0], most, begin, end);
#endif
