// Pages, first step: the fragment that needs another page puts it in front of its texel's list. Which one comes where
// does not matter: all but one are filled. [Crassin10]
layout(local_size_x = 64) in;
#include "passes/ldm/pages_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint arrival = fragment.arrival_depth >> 16;
    if (arrival >= MAX_LAYERS) {
        atomicAdd(dropped, 1u);
        atomicAdd(chunk_total, 0xffffffffu);
        return;
    }
    if (arrival % PAGE_DEPTHS != 0u) return;
    uint page = atomicAdd(batch_extra, 1u) + 1u;
    if (page * PAGE_WORDS > uint(pages.length())) return;
    uint word = page_word(page);
    pages[word] = atomicExchange(heads[batch_texel + fragment.texel], page);
    for (uint i = 1u; i < PAGE_WORDS; ++i) pages[word + i] = 0xffffffffu;
}
