#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

/// Constants of sparse_builder.glsl.
struct PlaceSparse {
    unsigned first_word, word_count, map_words, map_texels, depth_words;
    IR_FIELDS(first_word, word_count, map_words, map_texels, depth_words)
};

/// Contiguous sorted arrays whose offsets are kept, and summed, for texels with fragments alone.
/// [Vasilakis12] Texels are told from empty ones by a bit each, in words of 32 texels that say where their
/// offsets and depths begin; offsets count from there, in 16 bits, or in 32 where a word's texels hold more
/// than 65,535 depths.
///
/// DEVIATION [Vasilakis12 §3]: sums are taken in the order of texels, in place of atomic additions to a few
/// shared counters, so that the arrays lie in the same order in every run; and empty texels take a bit, not a
/// count and a head.
class SparseStorage : public Storage {
  public:
    SparseStorage(graph::GraphBuilder& builder, const Layout& layout)
        : Storage(layout), sorted_(declare_sorted_depths(builder, layout)) {
        using graph::FieldType;
        words_ =
            declare(builder,
                    {.text = {.key = "ldm.texel_words",
                              .label = "Texels with fragments",
                              .doc = "For each 32 texels: a bit for those with fragments; the first of their "
                                     "offsets, those of 32 bits marked by 2^31; and the first depth."},
                     .name = "LdmTexelWords",
                     .fields = {{"occupied", FieldType::u32},
                                {"offsets", FieldType::u32},
                                {"depths", FieldType::u32}},
                     .elements = batch_words()});
        offsets_ = declare(
            builder, {.text = {.key = "ldm.sparse_offsets",
                               .label = "Offsets of texels",
                               .doc = "Number of a texel's first depth, counted from that of its word, for "
                                      "all texels with fragments but the word's first; 16 bits each, or "
                                      "two halves of 32 bits."},
                      .name = "LdmSparseOffsets",
                      .fields = {{"pair", FieldType::u32}},
                      .elements = layout_.batch_maps * layout_.map_texels() / 2 + 1,
                      .growable = true});
        sums_ = declare(
            builder, {.text = {.key = "ldm.word_sums",
                               .label = "Sums of a chunk",
                               .doc = "For each 32 texels of the chunk that was built last: bits, halves of "
                                      "offsets, and depths."},
                      .name = "LdmWordSums",
                      .fields = {{"occupied", FieldType::u32},
                                 {"offsets", FieldType::u32},
                                 {"depths", FieldType::u32}},
                      .elements = layout_.chunk_maps * map_words()});
        offset_words_requested_ =
            count_requested(builder, "ldm.offset_words", "OffsetsRequested", "Words of offsets", offsets_);
    }

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_SPARSE_ARRAYS", "1"}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {words_, offsets_, sorted_.depths}; }
    std::vector<graph::BufferRef> scratch() const override {
        return {sums_, sorted_.unsorted, sorted_.deep_texels};
    }
    std::vector<graph::CounterRef> counters() const override {
        return sorted_.counters(offset_words_requested_);
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        place(context, chunk);
        sorted_.scatter_and_sort(context, list, chunk, layout_);
    }
    /// Without the offsets, whose number is that of texels with fragments.
    std::uint64_t table_bytes(const graph::PassContext&) const override { return batch_words() * 12; }
    double fragment_bytes() const override { return 2; }

  private:
    /// Of 32 texels; each map begins a new one.
    std::uint64_t map_words() const { return (layout_.map_texels() + 31) / 32; }
    /// And one that ends the last map.
    std::uint64_t batch_words() const { return layout_.batch_maps * map_words() + 1; }
    void place(const graph::PassContext& context, const Chunk& chunk) const {
        const PlaceSparse constants{.first_word = static_cast<unsigned>(chunk.first_map * map_words()),
                                    .word_count = static_cast<unsigned>(chunk.maps * map_words()),
                                    .map_words = static_cast<unsigned>(map_words()),
                                    .map_texels = static_cast<unsigned>(layout_.map_texels()),
                                    .depth_words = static_cast<unsigned>(context.capacity(sorted_.depths))};
        const auto run = [&](const char* file, std::int64_t invocations) {
            run_program(context, {{file}}, constants, invocations);
        };
        run("passes/ldm/sparse_sums.comp", constants.word_count);
        run("passes/ldm/sparse_bases.comp", 1);
        run("passes/ldm/sparse_offsets.comp", constants.word_count);
    }

    SortedDepths sorted_;
    graph::BufferRef words_, offsets_, sums_;
    graph::CounterRef offset_words_requested_;
};

}  // namespace

StoragePointer make_sparse_arrays(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<SparseStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
