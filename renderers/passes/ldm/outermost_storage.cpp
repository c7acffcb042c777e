#include "renderers/passes/ldm/outermost_storage.h"

namespace ir::passes::ldm {

OutermostStorage::OutermostStorage(graph::GraphBuilder& builder, const Layout& layout) : layout_(layout) {
    texels_ = builder.buffer({.text = {.key = "ldm.outermost",
                                       .label = "Outermost depths",
                                       .doc = "Of each texel, in quanta: largest depth << 16 | largest of "
                                              "65535 - depth; 0 where there is no surface."},
                              .name = "LdmOutermost",
                              .fields = {{"depths", graph::FieldType::u32}},
                              .elements = batch_texels(),
                              .fingerprint = layout.fingerprint});
    between_ = builder.counter({.key = "ldm.between",
                                .name = "Between",
                                .label = "Fragments between",
                                .doc = "That are not kept: between the outermost two of their texel."});
}

void OutermostStorage::begin_batch(const graph::PassContext& context) const {
    context.clear(texels_);
}

void OutermostStorage::store(const graph::PassContext& context, const FragmentList& list,
                             const Chunk& chunk) const {
    context.use({{"passes/ldm/outermost_raise.comp"}}).set(chunk_constants(chunk, layout_));
    dispatch_indirect(context, list.state, fragment_groups_word);
    context.barrier();
}

}  // namespace ir::passes::ldm
