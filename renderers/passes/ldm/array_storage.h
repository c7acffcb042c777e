#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// Contiguous sorted arrays, with 16-bit depths and 16-bit offsets from each row of texels' first depth. A
/// row of more than 65,535 fragments makes the offsets' buffer grow to hold 32 bits each.
class ArrayStorage : public Storage {
  public:
    /// Whether a batch is kept, or the chunk that was built last, for another storage to read (`layout` is
    /// that of a chunk then).
    enum class Holds { batch, one_chunk };
    ArrayStorage(graph::GraphBuilder& builder, const Layout& layout, Holds holds = Holds::batch);

    std::map<std::string, std::string> defines(const graph::PassContext& context,
                                               int first_binding) const override;
    std::vector<graph::BufferRef> buffers() const override { return {rows_, offsets_, depths_}; }
    std::vector<graph::BufferRef> scratch() const override { return {unsorted_, deep_texels_}; }
    std::vector<graph::CounterRef> counters() const override {
        return {depth_words_asked_, offset_words_asked_, unsorted_asked_, most_layers_};
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 2; }

    graph::BufferRef depths() const { return depths_; }

  private:
    bool is_wide(const graph::PassContext& context) const;
    std::uint64_t batch_rows() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.resolution;
    }
    /// Words that the offsets of a row take in 16 bits: one more than there are texels.
    std::uint64_t row_words() const { return (layout_.resolution + 2) / 2; }

    Layout layout_;
    Holds holds_;
    graph::BufferRef rows_, offsets_, depths_, unsorted_, deep_texels_;
    graph::CounterRef depth_words_asked_, offset_words_asked_, unsorted_asked_, most_layers_;
};

}  // namespace ir::passes::ldm
