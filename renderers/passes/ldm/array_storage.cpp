#include "renderers/passes/ldm/array_storage.h"

namespace ir::passes::ldm {

ArrayStorage::ArrayStorage(graph::GraphBuilder& builder, const Layout& layout, Holds holds)
    : layout_(layout), holds_(holds) {
    using graph::FieldType;
    rows_ = builder.buffer({.text = {.key = "ldm.rows",
                                     .label = "Rows of texels",
                                     .doc = "Number of the first depth of each row of texels."},
                            .name = "LdmRows",
                            .fields = {{"first", FieldType::u32}},
                            .elements = batch_rows()});
    offsets_ = builder.buffer({.text = {.key = "ldm.offsets",
                                        .label = "Offsets of texels",
                                        .doc = "Number of each texel's first depth, counted from the row's; "
                                               "two of 16 bits per word, or one of 32 bits."},
                               .name = "LdmOffsets",
                               .fields = {{"pair", FieldType::u32}},
                               .elements = batch_rows() * row_words(),
                               .growable = true});
    sorted_ = declare_sorted_depths(builder, layout);
    offset_words_requested_ = builder.counter({.key = "ldm.offset_words",
                                               .name = "OffsetsAsked",
                                               .label = "Words of offsets",
                                               .doc = "Of a batch of maps.",
                                               .growth_of = offsets_});
}

bool ArrayStorage::is_wide(const graph::PassContext& context) const {
    return context.capacity(offsets_) >= 2 * batch_rows() * row_words();
}

std::map<std::string, std::string> ArrayStorage::defines(const graph::PassContext& context) const {
    std::map<std::string, std::string> result{{"LDM_ARRAYS", "1"}};
    if (is_wide(context)) result["LDM_WIDE"] = "1";
    // Before it has grown the table may be too small for any query.
    if (context.capacity(offsets_) < batch_rows() * row_words()) result["LDM_EMPTY"] = "1";
    return result;
}

void ArrayStorage::store(const graph::PassContext& context, const FragmentList& list,
                         const Chunk& chunk) const {
    std::map<std::string, std::string> defines;
    if (is_wide(context)) defines["LDM_WIDE"] = "1";
    if (holds_ == Holds::one_chunk) defines["ONE_CHUNK"] = "1";
    const int rows = chunk.maps * layout_.resolution;
    const auto use = [&](const char* file) -> const gl::Program& {
        const auto& program = context.use({{file}, defines});
        program.set("first_row", static_cast<unsigned>(chunk.first_map * layout_.resolution));
        program.set("row_count", static_cast<unsigned>(rows));
        program.set("resolution", static_cast<unsigned>(layout_.resolution));
        return program;
    };
    use("passes/ldm/array_rows.comp").dispatch(rows);
    context.barrier();
    const auto& bases = use("passes/ldm/array_bases.comp");
    bases.set("packed_words", static_cast<unsigned>(batch_rows() * row_words()));
    bases.set("wide_words", static_cast<unsigned>(2 * batch_rows() * row_words()));
    bases.dispatch(1);
    context.barrier();
    use("passes/ldm/array_offsets.comp").dispatch(rows);
    context.barrier();
    sorted_.scatter_and_sort(context, list, chunk, layout_, defines);
}

std::uint64_t ArrayStorage::table_bytes(const graph::PassContext& context) const {
    return 4 * batch_rows() * (1 + row_words() * (is_wide(context) ? 2 : 1));
}

}  // namespace ir::passes::ldm
