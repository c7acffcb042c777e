#include "renderers/passes/ldm/sorted_list_storage.h"

#include "renderers/passes/ldm/sorted_depths.h"

namespace ir::passes::ldm {

SortedListStorage::SortedListStorage(graph::GraphBuilder& builder, const Layout& layout)
    : ListStorage(builder, layout) {
    const std::uint64_t texels = layout.chunk_maps * layout.map_texels();
    deep_texels_ = declare_deep_texels(builder, layout);
    successors_ = builder.buffer({.text = {.key = "ldm.successors",
                                           .label = "Successors of nodes",
                                           .doc = "Of the fragments of the deepest texels of the chunk that "
                                                  "was built last: the next node in order.",
                                           .semantic = Semantic::id},
                                  .name = "LdmSuccessors",
                                  .fields = {{"node", graph::FieldType::u32}},
                                  .elements = texels,
                                  .growable = true,
                                  .fingerprint = layout.fingerprint});
    successors_requested_ = builder.counter({.key = "ldm.requested_successors",
                                             .name = "SuccessorsRequested",
                                             .label = "Successors of the largest chunk",
                                             .growth_of = successors_});
}

void SortedListStorage::store(const graph::PassContext& context, const FragmentList& list,
                              const Chunk& chunk) const {
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

}  // namespace ir::passes::ldm
