#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

/// Depths of 16 bits in a page. On Sponza pages of 4 and of 6 take the least memory (4.07 and 4.08 bytes per
/// fragment with heads; of 2 4.78, of 8 4.32); with 6 there are fewer links to follow, and a page is four
/// words.
inline constexpr int page_depths = 6;

/// Paged per-pixel singly linked lists, sorted when a chunk is complete. The number of a fragment at its
/// texel is known before any is stored, so that pages are linked in a step of their own, without locks.
/// [Crassin10]
class PageStorage : public Storage {
  public:
    PageStorage(graph::GraphBuilder& builder, const Layout& layout) : Storage(layout) {
        using graph::FieldType;
        const std::uint64_t texels = layout.batch_maps * layout.map_texels(),
                            chunk_texels = layout.chunk_maps * layout.map_texels();
        heads_ =
            declare(builder, {.text = {.key = "ldm.page_heads",
                                       .label = "Heads of lists of pages",
                                       .doc = "First page of each texel's list, counted from 1; 0: empty.",
                                       .semantic = Semantic::id},
                              .name = "LdmPageHeads",
                              .fields = {{"page", FieldType::u32}},
                              .elements = texels});
        pages_ =
            declare(builder, {.text = {.key = "ldm.pages",
                                       .label = "Pages",
                                       .doc = "Next page, counted from 1 (0: none), and sorted depths in "
                                              "quanta, two per word; 65535: none."},
                              .name = "LdmPages",
                              .fields = {{"next", FieldType::u32}, {"pair", FieldType::u32, page_depths / 2}},
                              .elements = texels * (expected_layers + page_depths - 1) / page_depths,
                              .growable = true});
        deep_texels_ = declare_deep_texels(builder, layout);
        ranks_ =
            declare(builder, {.text = {.key = "ldm.ranks",
                                       .label = "Ranks of fragments",
                                       .doc = "Of the fragments of the deepest texels of the chunk that was "
                                              "built last: their place in order."},
                              .name = "LdmRanks",
                              .fields = {{"rank", FieldType::u32}},
                              .elements = chunk_texels * expected_layers,
                              .growable = true});
        pages_requested_ =
            count_requested(builder, "ldm.requested_pages", "PagesRequested", "Pages of a batch", pages_);
        ranks_requested_ = builder.counter({.key = "ldm.requested_ranks",
                                            .name = "RanksRequested",
                                            .label = "Ranks of the largest chunk",
                                            .growth_of = ranks_});
    }

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_PAGES", "1"}, {"LDM_PAGE_DEPTHS", std::to_string(page_depths)}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {heads_, pages_}; }
    std::vector<graph::BufferRef> scratch() const override { return {deep_texels_, ranks_}; }
    std::vector<graph::CounterRef> counters() const override { return {pages_requested_, ranks_requested_}; }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext& context) const override { context.clear(heads_); }
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
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
    std::uint64_t table_bytes(const graph::PassContext&) const override {
        return layout_.batch_maps * layout_.map_texels() * 4;
    }
    double fragment_bytes() const override { return 0; }  // pages are counted one by one

  private:
    graph::BufferRef heads_, pages_, deep_texels_, ranks_;
    graph::CounterRef pages_requested_, ranks_requested_;
};

}  // namespace

StoragePointer make_pages(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<PageStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
