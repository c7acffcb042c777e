#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {

using graph::FieldType;

graph::BufferRef declare_deep_texels(graph::GraphBuilder& builder, const Layout& layout) {
    return builder.buffer(
        {.text = {.key = "ldm.deep_texels",
                  .label = "Deep texels of a chunk",
                  .doc = "Texels with more than 16 layers, of the chunk that was built last.",
                  .semantic = Semantic::id},
         .name = "LdmDeepTexels",
         .fields = {{"texel", FieldType::u32}},
         .elements = layout.chunk_maps * layout.map_texels(),
         .fingerprint = layout.fingerprint});
}

SortedDepths declare_sorted_depths(graph::GraphBuilder& builder, const Layout& layout) {
    SortedDepths sorted;
    const auto nodes_per_word = layout.keeps_slopes() ? 1 : 2;
    sorted.depths = builder.buffer(
        {.text = {.key = "ldm.depths",
                  .label = "Depths",
                  .doc = "Sorted depths in quanta, texel by texel: two per word, "
                         "or one << 16 | codes of its slopes.",
                  .semantic = Semantic::depth},
         .name = "LdmDepths",
         .fields = {{"word", FieldType::u32}},
         .elements = layout.batch_maps * layout.map_texels() * expected_layers / nodes_per_word,
         .growable = true,
         .fingerprint = layout.fingerprint});
    sorted.unsorted =
        builder.buffer({.text = {.key = "ldm.unsorted",
                                 .label = "Depths of a chunk",
                                 .doc = "Nodes of the chunk that was built last, texel by texel: "
                                        "a depth, or one << 16 | codes of its slopes.",
                                 .semantic = Semantic::depth},
                        .name = "LdmUnsorted",
                        .fields = {{"node", FieldType::u32}},
                        .elements = layout.chunk_maps * layout.map_texels() * expected_layers,
                        .growable = true,
                        .fingerprint = layout.fingerprint});
    sorted.deep_texels = declare_deep_texels(builder, layout);
    sorted.words_requested =
        count_requested(builder, "ldm.depth_words", "DepthsRequested", "Words of depths", sorted.depths);
    sorted.unsorted_requested = builder.counter({.key = "ldm.chunk_depths",
                                                 .name = "UnsortedRequested",
                                                 .label = "Depths of the largest chunk",
                                                 .growth_of = sorted.unsorted});
    sorted.max_layers = builder.counter({.key = "ldm.max_layers",
                                         .name = "MaxLayers",
                                         .label = "Maximum layers",
                                         .doc = "Length of the longest sequence of depths."});
    return sorted;
}

void SortedDepths::scatter_and_sort(const graph::PassContext& context, const FragmentList& list,
                                    const Chunk& chunk, const Layout& layout,
                                    const std::map<std::string, std::string>& defines) const {
    const auto constants = chunk_constants(chunk, layout);
    const auto use = [&](const char* file) -> const gl::Program& {
        const auto& program = context.use({{file}, defines});
        program.set(constants);
        return program;
    };
    use("passes/ldm/array_scatter.comp");
    dispatch_indirect(context, list.state, fragment_groups_word);
    context.barrier();
    use("passes/ldm/array_sort.comp").dispatch(constants.texel_count);
    context.barrier();
    use("passes/ldm/array_sort_deep.comp");
    dispatch_indirect(context, list.state, deep_groups_word);
    context.barrier();
    use("passes/ldm/array_sort_deepest.comp");
    dispatch_indirect(context, list.state, deepest_groups_word);
    context.barrier();
}

}  // namespace ir::passes::ldm
