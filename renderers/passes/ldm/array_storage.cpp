#include "renderers/passes/ldm/array_storage.h"

namespace ir::passes::ldm {

ArrayStorage::ArrayStorage(graph::GraphBuilder& builder, const Layout& layout, Holds holds)
    : layout_(layout), holds_(holds) {
    using graph::FieldType;
    const std::uint64_t texels = layout.batch_maps * layout.map_texels();
    const std::string lower = "directions or resolution";
    rows_ = builder.buffer({.text = {.key = "ldm.rows",
                                     .label = "Rows of texels",
                                     .doc = "Number of the first depth of each row of texels."},
                            .fields = {{"first", FieldType::u32}},
                            .elements = batch_rows()});
    offsets_ = builder.buffer({.text = {.key = "ldm.offsets",
                                        .label = "Offsets of texels",
                                        .doc = "Number of each texel's first depth, counted from the row's; "
                                               "two of 16 bits per word, or one of 32 bits."},
                               .fields = {{"pair", FieldType::u32}},
                               .elements = batch_rows() * row_words(),
                               .growable = true,
                               .lower = lower});
    depths_ = builder.buffer({.text = {.key = "ldm.depths",
                                       .label = "Depths",
                                       .doc = "Sorted depths in quanta, texel by texel; two per word.",
                                       .semantic = Semantic::depth},
                              .fields = {{"pair", FieldType::u32}},
                              .elements = texels * expected_layers / 2,
                              .growable = true,
                              .lower = lower});
    unsorted_ = builder.buffer({.text = {.key = "ldm.unsorted",
                                         .label = "Depths of a chunk",
                                         .doc = "Depths of the chunk that was built last, texel by texel.",
                                         .semantic = Semantic::depth},
                                .fields = {{"depth", FieldType::u32}},
                                .elements = layout.chunk_maps * layout.map_texels() * expected_layers,
                                .growable = true,
                                .lower = lower});
    deep_texels_ = builder.buffer({.text = {.key = "ldm.deep_texels",
                                            .label = "Deep texels of a chunk",
                                            .doc = "Texels with more than 16 layers, of the chunk that was "
                                                   "built last.",
                                            .semantic = Semantic::id},
                                   .fields = {{"texel", FieldType::u32}},
                                   .elements = layout.chunk_maps * layout.map_texels()});
    depth_words_asked_ = builder.counter({.key = "ldm.depth_words",
                                          .label = "Words of depths",
                                          .doc = "Of the largest batch of maps.",
                                          .growth_of = depths_});
    offset_words_asked_ = builder.counter({.key = "ldm.offset_words",
                                           .label = "Words of offsets",
                                           .doc = "Of a batch of maps.",
                                           .growth_of = offsets_});
    unsorted_asked_ = builder.counter(
        {.key = "ldm.chunk_depths", .label = "Depths of the largest chunk", .growth_of = unsorted_});
    most_layers_ = builder.counter({.key = "ldm.max_layers",
                                    .label = "Most layers",
                                    .doc = "Length of the longest sequence of depths."});
}

bool ArrayStorage::is_wide(const graph::PassContext& context) const {
    return context.capacity(offsets_) >= 2 * batch_rows() * row_words();
}

std::map<std::string, std::string> ArrayStorage::defines(const graph::PassContext& context,
                                                         int first_binding) const {
    std::map<std::string, std::string> result{{"LDM_ARRAYS", "1"},
                                              {"LDM_STORAGE", std::to_string(first_binding)}};
    if (is_wide(context)) result["LDM_WIDE"] = "1";
    // Before it has grown the table may be too small for any query.
    if (context.capacity(offsets_) < batch_rows() * row_words()) result["LDM_EMPTY"] = "1";
    return result;
}

void ArrayStorage::store(const graph::PassContext& context, const FragmentList& list,
                         const Chunk& chunk) const {
    bind(context, 13);
    context.bind_buffer(7, deep_texels_);
    context.bind_buffer(8, unsorted_);
    const int rows = chunk.maps * layout_.resolution;
    const auto use = [&](const char* file) -> const gl::Program& {
        gl::ProgramSource source{{file}};
        if (is_wide(context)) source.defines["LDM_WIDE"] = "1";
        if (holds_ == Holds::one_chunk) source.defines["ONE_CHUNK"] = "1";
        const auto& program = context.program(source);
        program.use();
        program.set("first_row", static_cast<unsigned>(chunk.first_map * layout_.resolution));
        program.set("row_count", static_cast<unsigned>(rows));
        program.set("resolution", static_cast<unsigned>(layout_.resolution));
        return program;
    };
    use("passes/ldm/array_rows.comp").dispatch(rows);
    context.barrier();
    context.bind_counter(9, depth_words_asked_);
    context.bind_counter(10, offset_words_asked_);
    context.bind_counter(11, unsorted_asked_);
    context.bind_counter(12, most_layers_);
    const auto& bases = use("passes/ldm/array_bases.comp");
    bases.set("packed_words", static_cast<unsigned>(batch_rows() * row_words()));
    bases.set("wide_words", static_cast<unsigned>(2 * batch_rows() * row_words()));
    bases.dispatch(1);
    context.barrier();
    use("passes/ldm/array_offsets.comp").dispatch(rows);
    context.barrier();
    use("passes/ldm/array_scatter.comp");
    dispatch_indirect(context, list.state, fragment_groups_word);
    context.barrier();
    use("passes/ldm/array_sort.comp").dispatch(chunk.maps * static_cast<std::int64_t>(layout_.map_texels()));
    context.barrier();
    use("passes/ldm/array_sort_deep.comp");
    dispatch_indirect(context, list.state, deep_groups_word);
    context.barrier();
    use("passes/ldm/array_sort_deepest.comp");
    dispatch_indirect(context, list.state, deepest_groups_word);
    context.barrier();
}

std::uint64_t ArrayStorage::table_bytes(const graph::PassContext& context) const {
    return 4 * batch_rows() * (1 + row_words() * (is_wide(context) ? 2 : 1));
}

}  // namespace ir::passes::ldm
