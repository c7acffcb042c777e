// Pages, third step: one invocation sorts one texel's depths in registers; and with DEEP, after it, one texel with more
// than FEW_LAYERS, where it does not hold up its neighbours. Texels of more than MAX_IN_REGISTERS are left to
// pages_rank.comp.
#ifdef DEEP
layout(local_size_x = 64) in;
#else
layout(local_size_x = 128) in;
#endif
#include "passes/ldm/pages_builder.glsl"
#include "passes/ldm/list_index.glsl"
#include "passes/ldm/networks.glsl"

#ifdef DEEP
#define LAYERS 32
#else
#define LAYERS 16
#endif
const int MAX_PAGES = (LAYERS + LDM_PAGE_DEPTHS - 1) / LDM_PAGE_DEPTHS;

void main() {
#ifdef DEEP
    uint index = list_index();
    if (index >= min(deep_listed, uint(deep_list.length()))) return;
    uint texel = deep_list[index], count = counts[texel];
    if (count > MAX_IN_REGISTERS) {
        deepest_groups[0] = fragment_groups[0];
        deepest_groups[1] = fragment_groups[1];
        return;
    }
#else
    uint texel = gl_GlobalInvocationID.x;
    if (texel >= texel_count) return;
    uint count = counts[texel];
    if (count > FEW_LAYERS) {
        uint place = atomicAdd(deep_listed, 1u);
        if (place < uint(deep_list.length())) deep_list[place] = texel;
        return;
    }
    if (count < 2u) return;
#endif
    uint head = heads[batch_texel + texel], page = head;
    uint v[LAYERS];
    for (int i = 0; i < LAYERS; ++i) v[i] = NO_DEPTH;
    for (int p = 0; p < MAX_PAGES; ++p) {
        if (page == 0u) break;
        for (int i = 0; i < LDM_PAGE_DEPTHS; ++i)
            if (p * LDM_PAGE_DEPTHS + i < LAYERS) v[p * LDM_PAGE_DEPTHS + i] = depth_in(page, uint(i));
        page = pages[page_word(page)];
    }
#ifdef DEEP
    SORT_32(0)
#else
    SORT_16(0)
#endif
    page = head;
    for (int p = 0; p < MAX_PAGES; ++p) {
        if (page == 0u) break;
        uint word = page_word(page);
        for (int i = 0; i < LDM_PAGE_DEPTHS; i += 2) {
            int k = p * LDM_PAGE_DEPTHS + i;
            pages[word + 1u + uint(i) / 2u] =
                (k < LAYERS ? v[k] : NO_DEPTH) | (k + 1 < LAYERS ? v[k + 1] : NO_DEPTH) << 16;
        }
        page = pages[word];
    }
}
