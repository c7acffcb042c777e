#include "renderers/passes/ldm/storages.h"

namespace ir::passes::ldm {
namespace {

/// Constants of array_table.glsl.
struct ArrayTable {
    ChunkConstants chunk;
    unsigned packed_words, wide_words, depth_words;
    IR_FIELDS(chunk, packed_words, wide_words, depth_words)
};

/// Contiguous sorted arrays, with 16-bit depths and 16-bit offsets from each row of texels' first depth. A
/// row of more than 65,535 fragments makes the offsets' buffer grow to hold 32 bits each.
class ArrayStorage : public Storage {
  public:
    /// Whether a batch is kept, or the chunk that was built last, for another storage to read (`layout` is
    /// that of a chunk then).
    enum class Holds { batch, one_chunk };
    ArrayStorage(graph::GraphBuilder& builder, const Layout& layout, Holds holds = Holds::batch)
        : Storage(layout), holds_(holds) {
        using graph::FieldType;
        rows_ = declare(builder, {.text = {.key = "ldm.rows",
                                           .label = "Rows of texels",
                                           .doc = "Number of the first depth of each row of texels."},
                                  .name = "LdmRows",
                                  .fields = {{"first", FieldType::u32}},
                                  .elements = batch_rows()});
        offsets_ =
            declare(builder, {.text = {.key = "ldm.offsets",
                                       .label = "Offsets of texels",
                                       .doc = "Number of each texel's first depth, counted from the row's; "
                                              "two of 16 bits per word, or one of 32 bits."},
                              .name = "LdmOffsets",
                              .fields = {{"pair", FieldType::u32}},
                              .elements = batch_rows() * row_words(),
                              .growable = true});
        sorted_ = declare_sorted_depths(builder, layout);
        offset_words_requested_ =
            count_requested(builder, "ldm.offset_words", "OffsetsRequested", "Words of offsets", offsets_);
    }

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override {
        std::map<std::string, std::string> result{{"LDM_ARRAYS", "1"}};
        if (is_wide(context)) result["LDM_WIDE"] = "1";
        // Before it has grown the table may be too small for any query.
        if (context.capacity(offsets_) < batch_rows() * row_words()) result["LDM_EMPTY"] = "1";
        return result;
    }
    std::vector<graph::BufferRef> buffers() const override { return {rows_, offsets_, sorted_.depths}; }
    std::vector<graph::BufferRef> scratch() const override { return {sorted_.unsorted, sorted_.deep_texels}; }
    std::vector<graph::CounterRef> counters() const override {
        return sorted_.counters(offset_words_requested_);
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        auto defines = node_defines(layout_);
        if (is_wide(context)) defines["LDM_WIDE"] = "1";
        if (holds_ == Holds::one_chunk) defines["ONE_CHUNK"] = "1";
        const ArrayTable constants{chunk_constants(chunk, layout_),
                                   static_cast<unsigned>(batch_rows() * row_words()),
                                   static_cast<unsigned>(2 * batch_rows() * row_words()),
                                   static_cast<unsigned>(context.capacity(sorted_.depths))};
        const auto run = [&](const char* file, std::int64_t invocations) {
            run_program(context, {{file}, defines}, constants, invocations);
        };
        run("passes/ldm/array_rows.comp", constants.chunk.row_count);
        run("passes/ldm/array_bases.comp", 1);
        run("passes/ldm/array_offsets.comp", constants.chunk.row_count);
        sorted_.scatter_and_sort(context, list, chunk, layout_, defines);
    }
    std::uint64_t table_bytes(const graph::PassContext& context) const override {
        return 4 * batch_rows() * (1 + row_words() * (is_wide(context) ? 2 : 1));
    }
    double fragment_bytes() const override { return layout_.keeps_slopes() ? 4 : 2; }

    graph::BufferRef depths() const { return sorted_.depths; }

  private:
    bool is_wide(const graph::PassContext& context) const {
        return context.capacity(offsets_) >= 2 * batch_rows() * row_words();
    }
    std::uint64_t batch_rows() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.resolution;
    }
    /// Words that the offsets of a row take in 16 bits: one more than there are texels.
    std::uint64_t row_words() const { return (layout_.resolution + 2) / 2; }

    Holds holds_;
    SortedDepths sorted_;
    graph::BufferRef rows_, offsets_;
    graph::CounterRef offset_words_requested_;
};

/// Constants of packed_builder.glsl.
struct PackChunk {
    ChunkConstants chunk;
    unsigned table_words, depth_words;
    IR_FIELDS(chunk, table_words, depth_words)
};

/// Layout of the arrays that hold one chunk.
Layout chunk_layout(Layout layout) {
    layout.batch_maps = layout.chunk_maps;
    return layout;
}

/// Contiguous sorted arrays of short depths, bit by bit without gaps, one of those that are equal once
/// rounded, and 8 bits of offsets per texel (shaders/passes/ldm/packed_groups.glsl). Chunks are first stored
/// as arrays of 16 bits.
class PackedStorage : public Storage {
  public:
    PackedStorage(graph::GraphBuilder& builder, const Layout& layout)
        : Storage(layout), chunk_(builder, chunk_layout(layout), ArrayStorage::Holds::one_chunk) {
        using graph::FieldType;
        const std::uint64_t texels = layout.batch_maps * layout.map_texels();
        rows_ = declare(builder, {.text = {.key = "ldm.packed_rows",
                                           .label = "Rows of texels",
                                           .doc = "Number of the first depth of each row of texels."},
                                  .name = "LdmPackedRows",
                                  .fields = {{"first", FieldType::u32}},
                                  .elements = batch_rows()});
        groups_ =
            declare(builder, {.text = {.key = "ldm.packed_groups",
                                       .label = "Groups of texels",
                                       .doc = "Per eight texels of a row where their first depth is, counted "
                                              "from the row's (16 bits), and numbers of depths (6 bits "
                                              "each); at the end, nine words for each group with more."},
                              .name = "LdmGroups",
                              .fields = {{"word", FieldType::u32}},
                              .elements = table_words() + table_words() / 64,
                              .growable = true});
        depths_ =
            declare(builder, {.text = {.key = "ldm.packed_depths",
                                       .label = "Packed depths",
                                       .doc = "Sorted depths, texel by texel, of 11 bits each, with codes of "
                                              "slopes 27; 32 of them fill as many words.",
                                       .semantic = Semantic::depth},
                              .name = "LdmPackedDepths",
                              .fields = {{"word", FieldType::u32}},
                              .elements = texels * expected_layers * node_bits() / 32,
                              .growable = true});
        texels_ =
            declare(builder, {.text = {.key = "ldm.packed_texels",
                                       .label = "Texels of a chunk",
                                       .doc = "Number of the first packed depth of each texel of the chunk "
                                              "that was built last."},
                              .name = "LdmPackedTexels",
                              .fields = {{"first", FieldType::u32}},
                              .elements = layout.chunk_maps * layout.map_texels() + 1});
        depth_words_requested_ = count_requested(builder, "ldm.packed_depth_words", "DepthWordsRequested",
                                                 "Words of packed depths", depths_);
        group_words_requested_ = count_requested(builder, "ldm.packed_group_words", "GroupWordsRequested",
                                                 "Words of groups of texels", groups_);
        merged_ = builder.counter({.key = "ldm.merged",
                                   .name = "Merged",
                                   .label = "Merged fragments",
                                   .doc = "Whose depth equals another's of the texel once it is rounded."});
    }

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override {
        // Half of what is rounded away, and one quantum for rasterisation.
        std::map<std::string, std::string> result{
            {"LDM_PACKED_BITS", std::to_string(packed_bits)},
            {"LDM_ROUNDING", std::to_string((1 << (15 - packed_bits)) + 1) + ".0"}};
        // Before it has grown the table may be too small for any query.
        if (context.capacity(groups_) < table_words()) result["LDM_EMPTY"] = "1";
        return result;
    }
    std::vector<graph::BufferRef> buffers() const override { return {rows_, groups_, depths_}; }
    std::vector<graph::BufferRef> scratch() const override {
        auto result = chunk_.buffers();
        for (const auto buffer : chunk_.scratch()) result.push_back(buffer);
        result.push_back(texels_);
        return result;
    }
    std::vector<graph::CounterRef> counters() const override {
        auto result = chunk_.counters();
        for (const auto counter : {depth_words_requested_, group_words_requested_, merged_})
            result.push_back(counter);
        return result;
    }
    bool needs_arrivals() const override { return true; }
    int depth_bits() const override { return packed_bits; }
    void begin_batch(const graph::PassContext& context) const override { context.clear(depths_); }
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override {
        chunk_.store(context, list, {0, chunk.maps});
        const PackChunk constants{chunk_constants(chunk, layout_), static_cast<unsigned>(table_words()),
                                  static_cast<unsigned>(context.capacity(depths_))};
        auto defines = node_defines(layout_);
        defines["LDM_PACKED_BITS"] = std::to_string(packed_bits);
        const auto run = [&](const char* file, std::int64_t invocations) {
            run_program(context, {{file}, defines}, constants, invocations);
        };
        run("passes/ldm/packed_count.comp", constants.chunk.texel_count);
        run("passes/ldm/packed_rows.comp", constants.chunk.row_count);
        run("passes/ldm/packed_bases.comp", 1);
        run("passes/ldm/packed_groups.comp", constants.chunk.row_count);
        run("passes/ldm/packed_write.comp", constants.chunk.texel_count);
    }
    std::uint64_t table_bytes(const graph::PassContext&) const override {
        return 4 * (batch_rows() + table_words());
    }
    double fragment_bytes() const override { return node_bits() / 8.0; }

  private:
    int node_bits() const { return packed_bits + (layout_.keeps_slopes() ? 16 : 0); }
    std::uint64_t batch_rows() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.resolution;
    }
    /// Words of groups, two for eight texels, without those of wide groups.
    std::uint64_t table_words() const { return 2 * batch_rows() * ((layout_.resolution + 7) / 8); }

    ArrayStorage chunk_;
    graph::BufferRef rows_, groups_, depths_, texels_;
    graph::CounterRef depth_words_requested_, group_words_requested_, merged_;
};

}  // namespace

StoragePointer make_arrays(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<ArrayStorage>(builder, layout);
}

StoragePointer make_packed_arrays(graph::GraphBuilder& builder, const Layout& layout) {
    return std::make_shared<PackedStorage>(builder, layout);
}

}  // namespace ir::passes::ldm
