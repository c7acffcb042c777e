#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

/// Pre-sorted per-pixel singly linked lists. [Aalund15 §3, Lefebvre14]
class ListStorage : public Storage {
  public:
    ListStorage(graph::GraphBuilder& builder, const Layout& layout) : Storage(layout) {
        const std::uint64_t texels = layout.batch_maps * layout.map_texels();
        heads_ =
            declare(builder, {.text = {.key = "ldm.heads",
                                       .label = "Heads of lists",
                                       .doc = "First node of each texel's list, counted from 1; 0: empty.",
                                       .semantic = Semantic::id},
                              .name = "LdmHeads",
                              .fields = {{"node", graph::FieldType::u32}},
                              .elements = texels});
        nodes_ =
            declare(builder, {.text = {.key = "ldm.list_nodes",
                                       .label = "Nodes of lists",
                                       .doc = "Next node, counted from 1 (0: none), and depth in quanta."},
                              .name = "LdmNodes",
                              .fields = {{"next", graph::FieldType::u32}, {"depth", graph::FieldType::u32}},
                              .elements = texels * expected_layers,
                              .growable = true});
        nodes_requested_ =
            count_requested(builder, "ldm.requested_nodes", "NodesRequested", "Nodes of a batch", nodes_);
    }

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_LINKED_LISTS", "1"}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {heads_, nodes_}; }
    std::vector<graph::CounterRef> counters() const override { return {nodes_requested_}; }
    void begin_batch(const graph::PassContext& context) const override { context.clear(heads_); }
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        if (list.fragments.index >= 0) {
            const auto& insert = context.use({{"passes/ldm/insert_lists.comp"}});
            insert.set(chunk_constants(chunk, layout_));
            dispatch_indirect(context, list.state, fragment_groups_word);
            context.barrier();
        }
        context.use({{"passes/ldm/count_nodes.comp"}}).dispatch(1);
        context.barrier();
    }
    std::uint64_t table_bytes(const graph::PassContext&) const override {
        return layout_.batch_maps * layout_.map_texels() * 4;
    }
    double fragment_bytes() const override { return 8; }

  protected:
    graph::BufferRef heads_, nodes_;
    graph::CounterRef nodes_requested_;
};

/// Per-pixel singly linked lists in order of arrival, each sorted when a chunk is complete. What queries read
/// is what ListStorage makes. [Yang10]
class SortedListStorage : public ListStorage {
  public:
    SortedListStorage(graph::GraphBuilder& builder, const Layout& layout) : ListStorage(builder, layout) {
        const std::uint64_t texels = layout.chunk_maps * layout.map_texels();
        deep_texels_ = declare_deep_texels(builder, layout);
        successors_ =
            declare(builder, {.text = {.key = "ldm.successors",
                                       .label = "Successors of nodes",
                                       .doc = "Of the fragments of the deepest texels of the chunk that "
                                              "was built last: the next node in order.",
                                       .semantic = Semantic::id},
                              .name = "LdmSuccessors",
                              .fields = {{"node", graph::FieldType::u32}},
                              .elements = texels,
                              .growable = true});
        successors_requested_ = builder.counter({.key = "ldm.requested_successors",
                                                 .name = "SuccessorsRequested",
                                                 .label = "Successors of the largest chunk",
                                                 .growth_of = successors_});
    }

    std::vector<graph::BufferRef> scratch() const override { return {deep_texels_, successors_}; }
    std::vector<graph::CounterRef> counters() const override {
        return {nodes_requested_, successors_requested_};
    }
    bool needs_arrivals() const override { return true; }
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        const auto constants = chunk_constants(chunk, layout_);
        const auto use = [&](const char* file) -> const gl::Program& {
            const auto& program = context.use(gl::ProgramSource{{file}});
            program.set(constants);
            return program;
        };
        const auto run_indirect = [&](const char* file, int word) {
            use(file);
            dispatch_indirect(context, list.state, word);
            context.barrier();
        };
        run_indirect("passes/ldm/lists_push.comp", fragment_groups_word);
        use("passes/ldm/lists_sort.comp").dispatch(constants.texel_count);
        context.barrier();
        context.use({{"passes/ldm/lists_prepare.comp"}}).dispatch(1);
        context.barrier();
        run_indirect("passes/ldm/lists_sort_deep.comp", deep_groups_word);
        run_indirect("passes/ldm/lists_find_next.comp", deepest_groups_word);
        run_indirect("passes/ldm/lists_relink.comp", deepest_groups_word);
    }

  private:
    graph::BufferRef deep_texels_, successors_;
    graph::CounterRef successors_requested_;
};

}  // namespace

StoragePointer make_lists(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<ListStorage>(builder, layout);
}

StoragePointer make_sorted_lists(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<SortedListStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
