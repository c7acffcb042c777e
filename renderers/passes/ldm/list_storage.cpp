#include "renderers/passes/ldm/list_storage.h"

namespace ir::passes::ldm {

ListStorage::ListStorage(graph::GraphBuilder& builder, const Layout& layout) : layout_(layout) {
    const std::uint64_t texels = layout.batch_maps * layout.map_texels();
    heads_ = builder.buffer({.text = {.key = "ldm.heads",
                                      .label = "Heads of lists",
                                      .doc = "First node of each texel's list, counted from 1; 0: empty.",
                                      .semantic = Semantic::id},
                             .name = "LdmHeads",
                             .fields = {{"node", graph::FieldType::u32}},
                             .elements = texels,
                             .fingerprint = layout.fingerprint});
    nodes_ = builder.buffer({.text = {.key = "ldm.list_nodes",
                                      .label = "Nodes of lists",
                                      .doc = "Next node, counted from 1 (0: none), and depth in quanta."},
                             .name = "LdmNodes",
                             .fields = {{"next", graph::FieldType::u32}, {"depth", graph::FieldType::u32}},
                             .elements = texels * expected_layers,
                             .growable = true,
                             .fingerprint = layout.fingerprint});
    nodes_requested_ = builder.counter({.key = "ldm.requested_nodes",
                                        .name = "NodesRequested",
                                        .label = "Nodes of a batch",
                                        .doc = "Of the largest batch of maps.",
                                        .growth_of = nodes_});
}

std::map<std::string, std::string> ListStorage::defines(const graph::PassContext&) const {
    return {{"LDM_LINKED_LISTS", "1"}};
}

void ListStorage::begin_batch(const graph::PassContext& context) const {
    context.clear(heads_);
}

void ListStorage::store(const graph::PassContext& context, const FragmentList& list,
                        const Chunk& chunk) const {
    if (list.fragments.index >= 0) {
        const auto& insert = context.use({{"passes/ldm/insert_lists.comp"}});
        insert.set(chunk_constants(chunk, layout_));
        dispatch_indirect(context, list.state, fragment_groups_word);
        context.barrier();
    }
    context.use({{"passes/ldm/count_nodes.comp"}}).dispatch(1);
    context.barrier();
}

std::uint64_t ListStorage::table_bytes(const graph::PassContext&) const {
    return layout_.batch_maps * layout_.map_texels() * 4;
}

}  // namespace ir::passes::ldm
