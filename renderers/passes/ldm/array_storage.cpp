#include "renderers/passes/ldm/array_storage.h"

namespace ir::passes::ldm {
namespace {

/// Constants of array_table.glsl.
struct ArrayTable {
    ChunkConstants chunk;
    unsigned packed_words, wide_words;
    IR_FIELDS(chunk, packed_words, wide_words)
};

}  // namespace

ArrayStorage::ArrayStorage(graph::GraphBuilder& builder, const Layout& layout, Holds holds)
    : layout_(layout), holds_(holds) {
    using graph::FieldType;
    rows_ = builder.buffer({.text = {.key = "ldm.rows",
                                     .label = "Rows of texels",
                                     .doc = "Number of the first depth of each row of texels."},
                            .name = "LdmRows",
                            .fields = {{"first", FieldType::u32}},
                            .elements = batch_rows(),
                            .fingerprint = layout.fingerprint});
    offsets_ = builder.buffer({.text = {.key = "ldm.offsets",
                                        .label = "Offsets of texels",
                                        .doc = "Number of each texel's first depth, counted from the row's; "
                                               "two of 16 bits per word, or one of 32 bits."},
                               .name = "LdmOffsets",
                               .fields = {{"pair", FieldType::u32}},
                               .elements = batch_rows() * row_words(),
                               .growable = true,
                               .fingerprint = layout.fingerprint});
    sorted_ = declare_sorted_depths(builder, layout);
    offset_words_requested_ = builder.counter({.key = "ldm.offset_words",
                                               .name = "OffsetsRequested",
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
    const ArrayTable constants{chunk_constants(chunk, layout_),
                               static_cast<unsigned>(batch_rows() * row_words()),
                               static_cast<unsigned>(2 * batch_rows() * row_words())};
    const auto run = [&](const char* file, std::int64_t invocations) {
        const auto& program = context.use({{file}, defines});
        program.set(constants);
        program.dispatch(invocations);
        context.barrier();
    };
    run("passes/ldm/array_rows.comp", constants.chunk.row_count);
    run("passes/ldm/array_bases.comp", 1);
    run("passes/ldm/array_offsets.comp", constants.chunk.row_count);
    sorted_.scatter_and_sort(context, list, chunk, layout_, defines);
}

std::uint64_t ArrayStorage::table_bytes(const graph::PassContext& context) const {
    return 4 * batch_rows() * (1 + row_words() * (is_wide(context) ? 2 : 1));
}

}  // namespace ir::passes::ldm
