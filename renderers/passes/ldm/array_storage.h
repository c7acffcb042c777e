#pragma once

#include "renderers/passes/ldm/sorted_depths.h"

namespace ir::passes::ldm {

/// Contiguous sorted arrays, with 16-bit depths and 16-bit offsets from each row of texels' first depth. A
/// row of more than 65,535 fragments makes the offsets' buffer grow to hold 32 bits each.
class ArrayStorage : public Storage {
  public:
    /// Whether a batch is kept, or the chunk that was built last, for another storage to read (`layout` is
    /// that of a chunk then).
    enum class Holds { batch, one_chunk };
    ArrayStorage(graph::GraphBuilder& builder, const Layout& layout, Holds holds = Holds::batch);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {rows_, offsets_, sorted_.depths}; }
    std::vector<graph::BufferRef> scratch() const override { return {sorted_.unsorted, sorted_.deep_texels}; }
    std::vector<graph::CounterRef> counters() const override {
        return {sorted_.words_requested, offset_words_requested_, sorted_.unsorted_requested,
                sorted_.max_layers};
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 2; }

    graph::BufferRef depths() const { return sorted_.depths; }

  private:
    bool is_wide(const graph::PassContext& context) const;
    std::uint64_t batch_rows() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.resolution;
    }
    /// Words that the offsets of a row take in 16 bits: one more than there are texels.
    std::uint64_t row_words() const { return (layout_.resolution + 2) / 2; }

    Layout layout_;
    Holds holds_;
    SortedDepths sorted_;
    graph::BufferRef rows_, offsets_;
    graph::CounterRef offset_words_requested_;
};

}  // namespace ir::passes::ldm
