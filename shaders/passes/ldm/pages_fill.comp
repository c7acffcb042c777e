// Pages, second step: one invocation puts one fragment into the slot of its order of arrival.
layout(local_size_x = 64) in;
#include "passes/ldm/pages_builder.glsl"
#include "passes/ldm/list_index.glsl"

void main() {
    uint index = list_index();
    if (index >= min(fragment_count, uint(fragments.length()))) return;
    LdmFragment fragment = fragments[index];
    uint arrival = fragment.arrival_depth >> 16;
    if (arrival >= MAX_LAYERS) return;
    uint page = page_of(fragment.texel, arrival);
    if (page == 0u) return;
    uint slot = arrival % PAGE_DEPTHS;
    int shift = int(slot & 1u) << 4;
    // All bits are set before; the word's other half may be another invocation's.
    atomicAnd(pages[page_word(page) + 1u + slot / 2u], ~((~fragment.arrival_depth & 0xffffu) << shift));
}
