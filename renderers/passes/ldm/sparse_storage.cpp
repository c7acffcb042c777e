#include "renderers/passes/ldm/sparse_storage.h"

namespace ir::passes::ldm {
namespace {

/// Constants of sparse_builder.glsl.
struct PlaceSparse {
    unsigned first_word, word_count, map_words, map_texels;
    IR_FIELDS(first_word, word_count, map_words, map_texels)
};

}  // namespace

SparseStorage::SparseStorage(graph::GraphBuilder& builder, const Layout& layout)
    : layout_(layout), sorted_(declare_sorted_depths(builder, layout)) {
    using graph::FieldType;
    words_ = builder.buffer(
        {.text = {.key = "ldm.texel_words",
                  .label = "Texels with fragments",
                  .doc = "For each 32 texels: a bit for those with fragments; the first of their "
                         "offsets, those of 32 bits marked by 2^31; and the first depth."},
         .name = "LdmTexelWords",
         .fields = {{"occupied", FieldType::u32}, {"offsets", FieldType::u32}, {"depths", FieldType::u32}},
         .elements = batch_words(),
         .fingerprint = layout.fingerprint});
    offsets_ =
        builder.buffer({.text = {.key = "ldm.sparse_offsets",
                                 .label = "Offsets of texels",
                                 .doc = "Number of a texel's first depth, counted from that of its word, for "
                                        "all texels with fragments but the word's first; 16 bits each, or "
                                        "two halves of 32 bits."},
                        .name = "LdmSparseOffsets",
                        .fields = {{"pair", FieldType::u32}},
                        .elements = layout_.batch_maps * layout_.map_texels() / 2 + 1,
                        .growable = true,
                        .fingerprint = layout.fingerprint});
    sums_ = builder.buffer(
        {.text = {.key = "ldm.word_sums",
                  .label = "Sums of a chunk",
                  .doc = "For each 32 texels of the chunk that was built last: bits, halves of "
                         "offsets, and depths."},
         .name = "LdmWordSums",
         .fields = {{"occupied", FieldType::u32}, {"offsets", FieldType::u32}, {"depths", FieldType::u32}},
         .elements = layout_.chunk_maps * map_words(),
         .fingerprint = layout.fingerprint});
    offset_words_requested_ = builder.counter({.key = "ldm.offset_words",
                                               .name = "OffsetsRequested",
                                               .label = "Words of offsets",
                                               .doc = "Of the largest batch of maps.",
                                               .growth_of = offsets_});
}

std::map<std::string, std::string> SparseStorage::defines(const graph::PassContext&) const {
    return {{"LDM_SPARSE_ARRAYS", "1"}};
}

void SparseStorage::place(const graph::PassContext& context, const Chunk& chunk) const {
    const PlaceSparse constants{.first_word = static_cast<unsigned>(chunk.first_map * map_words()),
                                .word_count = static_cast<unsigned>(chunk.maps * map_words()),
                                .map_words = static_cast<unsigned>(map_words()),
                                .map_texels = static_cast<unsigned>(layout_.map_texels())};
    const auto run = [&](const char* file, std::int64_t invocations) {
        const auto& program = context.use({{file}});
        program.set(constants);
        program.dispatch(invocations);
        context.barrier();
    };
    run("passes/ldm/sparse_sums.comp", constants.word_count);
    run("passes/ldm/sparse_bases.comp", 1);
    run("passes/ldm/sparse_offsets.comp", constants.word_count);
}

void SparseStorage::store(const graph::PassContext& context, const FragmentList& list,
                          const Chunk& chunk) const {
    place(context, chunk);
    sorted_.scatter_and_sort(context, list, chunk, layout_);
}

std::uint64_t SparseStorage::table_bytes(const graph::PassContext&) const {
    return batch_words() * 12;
}

}  // namespace ir::passes::ldm
