#pragma once

#include "renderers/passes/ldm/sorted_depths.h"

namespace ir::passes::ldm {

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
    SparseStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {words_, offsets_, sorted_.depths}; }
    std::vector<graph::BufferRef> scratch() const override {
        return {sums_, sorted_.unsorted, sorted_.deep_texels};
    }
    std::vector<graph::CounterRef> counters() const override {
        return {sorted_.words_requested, offset_words_requested_, sorted_.unsorted_requested,
                sorted_.max_layers};
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    /// Without the offsets, whose number is that of texels with fragments.
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 2; }

  private:
    /// Of 32 texels; each map begins a new one.
    std::uint64_t map_words() const { return (layout_.map_texels() + 31) / 32; }
    /// And one that ends the last map.
    std::uint64_t batch_words() const { return layout_.batch_maps * map_words() + 1; }
    void place(const graph::PassContext& context, const Chunk& chunk) const;

    Layout layout_;
    SortedDepths sorted_;
    graph::BufferRef words_, offsets_, sums_;
    graph::CounterRef offset_words_requested_;
};

}  // namespace ir::passes::ldm
