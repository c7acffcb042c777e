// Pages, last steps, for texels that pages_sort.comp left: one invocation finds the place of one fragment by counting
// those that come before it, and with PLACE, when all are found, puts it there.
layout(local_size_x = 64) in;
#include "passes/ldm/pages_builder.glsl"
#include "passes/ldm/list_index.glsl"

layout(std430) buffer RanksRequested { uint ranks_requested; };

void main() {
    uint index = list_index();
    atomicMax(ranks_requested, fragment_count);
    if (index >= min(fragment_count, uint(fragments.length())) || fragment_count > uint(ranks.length())) return;
    LdmFragment fragment = fragments[index];
    uint arrival = fragment.arrival_depth >> 16, depth = fragment.arrival_depth & 0xffffu;
    if (counts[fragment.texel] <= MAX_IN_REGISTERS || arrival >= MAX_LAYERS) return;
    if (page_of(fragment.texel, arrival) == 0u) return;
#ifdef PLACE
    uint rank = ranks[index], page = page_of(fragment.texel, rank), slot = rank % PAGE_DEPTHS;
    if (page == 0u) return;
    uint word = page_word(page) + 1u + slot / 2u;
    int shift = int(slot & 1u) << 4;
    atomicAnd(pages[word], ~(0xffffu << shift));
    atomicOr(pages[word], depth << shift);
#else
    uint rank = 0u, place = 0u;
    for (uint page = heads[batch_texel + fragment.texel]; page != 0u; page = pages[page_word(page)])
        for (uint slot = 0u; slot < PAGE_DEPTHS; ++slot) {
            uint other = depth_in(page, slot);
            if (other < depth || (other == depth && place < arrival)) ++rank;
            ++place;
        }
    ranks[index] = rank;
#endif
}
