// What the steps of building pages share. A page: the next one, counted from 1 (0: none), and LDM_PAGE_DEPTHS depths of
// 16 bits, two per word; NO_DEPTH where there is none.
#include "passes/ldm/chunk.glsl"
#define LDM_ARRIVALS
#include "passes/ldm/fragments.glsl"

/// First page of each texel of the batch, from 1 on; 0: empty.
layout(std430) buffer LdmPageHeads { uint heads[]; };
layout(std430) buffer LdmPages { uint pages[]; };
/// Texels of the chunk with more than FEW_LAYERS.
layout(std430) buffer LdmDeepTexels { uint deep_list[]; };
/// Places in order of the fragments of the chunk's deepest texels.
layout(std430) buffer LdmRanks { uint ranks[]; };

const uint PAGE_DEPTHS = uint(LDM_PAGE_DEPTHS), PAGE_WORDS = 1u + PAGE_DEPTHS / 2u;
const uint NO_DEPTH = 65535u;
const uint FEW_LAYERS = 16u;
/// Beyond, each fragment counts those that come before it.
const uint MAX_IN_REGISTERS = 32u;

/// First word of a page that is counted from 1.
uint page_word(uint page) {
    return (page - 1u) * PAGE_WORDS;
}

/// The page that holds the texel's entry number `place`; 0: none.
uint page_of(uint texel, uint place) {
    uint page = heads[batch_texel + texel];
    for (uint i = place / PAGE_DEPTHS; i > 0u && page != 0u; --i) page = pages[page_word(page)];
    return page;
}

uint depth_in(uint page, uint slot) {
    return bitfieldExtract(pages[page_word(page) + 1u + slot / 2u], int(slot & 1u) << 4, 16);
}
