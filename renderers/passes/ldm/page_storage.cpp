#include "renderers/passes/ldm/page_storage.h"

#include "renderers/passes/ldm/sorted_depths.h"

namespace ir::passes::ldm {

PageStorage::PageStorage(graph::GraphBuilder& builder, const Layout& layout) : layout_(layout) {
    using graph::FieldType;
    const std::uint64_t texels = layout.batch_maps * layout.map_texels(),
                        chunk_texels = layout.chunk_maps * layout.map_texels();
    heads_ = builder.buffer({.text = {.key = "ldm.page_heads",
                                      .label = "Heads of lists of pages",
                                      .doc = "First page of each texel's list, counted from 1; 0: empty.",
                                      .semantic = Semantic::id},
                             .name = "LdmPageHeads",
                             .fields = {{"page", FieldType::u32}},
                             .elements = texels,
                             .fingerprint = layout.fingerprint});
    pages_ = builder.buffer({.text = {.key = "ldm.pages",
                                      .label = "Pages",
                                      .doc = "Next page, counted from 1 (0: none), and sorted depths in "
                                             "quanta, two per word; 65535: none."},
                             .name = "LdmPages",
                             .fields = {{"next", FieldType::u32}, {"pair", FieldType::u32, page_depths / 2}},
                             .elements = texels * (expected_layers + page_depths - 1) / page_depths,
                             .growable = true,
                             .fingerprint = layout.fingerprint});
    deep_texels_ = declare_deep_texels(builder, layout);
    ranks_ = builder.buffer({.text = {.key = "ldm.ranks",
                                      .label = "Ranks of fragments",
                                      .doc = "Of the fragments of the deepest texels of the chunk that was "
                                             "built last: their place in order."},
                             .name = "LdmRanks",
                             .fields = {{"rank", FieldType::u32}},
                             .elements = chunk_texels * expected_layers,
                             .growable = true,
                             .fingerprint = layout.fingerprint});
    pages_requested_ = builder.counter({.key = "ldm.requested_pages",
                                        .name = "PagesRequested",
                                        .label = "Pages of a batch",
                                        .doc = "Of the largest batch of maps.",
                                        .growth_of = pages_});
    ranks_requested_ = builder.counter({.key = "ldm.requested_ranks",
                                        .name = "RanksRequested",
                                        .label = "Ranks of the largest chunk",
                                        .growth_of = ranks_});
}

std::map<std::string, std::string> PageStorage::defines(const graph::PassContext&) const {
    return {{"LDM_PAGES", "1"}, {"LDM_PAGE_DEPTHS", std::to_string(page_depths)}};
}

void PageStorage::begin_batch(const graph::PassContext& context) const {
    context.clear(heads_);
}

void PageStorage::store(const graph::PassContext& context, const FragmentList& list,
                        const Chunk& chunk) const {
    const auto constants = chunk_constants(chunk, layout_);
    const auto use = [&](const char* file, const char* define = nullptr) -> const gl::Program& {
        gl::ProgramSource source{{file}, {{"LDM_PAGE_DEPTHS", std::to_string(page_depths)}}};
        if (define) source.defines[define] = "1";
        const auto& program = context.use(source);
        program.set(constants);
        return program;
    };
    const auto run_indirect = [&](int word, const char* file, const char* define = nullptr) {
        use(file, define);
        dispatch_indirect(context, list.state, word);
        context.barrier();
    };
    run_indirect(fragment_groups_word, "passes/ldm/pages_link.comp");
    run_indirect(fragment_groups_word, "passes/ldm/pages_fill.comp");
    use("passes/ldm/pages_sort.comp").dispatch(constants.texel_count);
    context.barrier();
    use("passes/ldm/pages_prepare.comp").dispatch(1);
    context.barrier();
    run_indirect(deep_groups_word, "passes/ldm/pages_sort.comp", "DEEP");
    run_indirect(deepest_groups_word, "passes/ldm/pages_rank.comp");
    run_indirect(deepest_groups_word, "passes/ldm/pages_rank.comp", "PLACE");
}

std::uint64_t PageStorage::table_bytes(const graph::PassContext&) const {
    return layout_.batch_maps * layout_.map_texels() * 4;
}

}  // namespace ir::passes::ldm
