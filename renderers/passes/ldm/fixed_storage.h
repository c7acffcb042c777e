#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// When the depths of fixed arrays are sorted.
enum class FixedOrder {
    after,   ///< Layers are kept in order of arrival, then sorted: which ones are lost is left to chance.
    arrival  ///< Each goes down the array by atomic exchanges: the nearest along the map's direction stay.
             ///< [Liu10]
};

/// Arrays of Layout::fixed_layers depths per texel, of 16 bits each. What does not fit is dropped and
/// counted. [Bavoil07, Liu10]
class FixedStorage : public Storage {
  public:
    FixedStorage(graph::GraphBuilder& builder, const Layout& layout, FixedOrder order);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {depths_}; }
    std::vector<graph::BufferRef> scratch() const override { return {chunk_}; }
    std::vector<graph::CounterRef> counters() const override { return {}; }
    bool needs_arrivals() const override { return order_ == FixedOrder::after; }
    void begin_batch(const graph::PassContext&) const override {}
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t texel_words() const { return static_cast<std::uint64_t>(layout_.fixed_layers + 1) / 2; }

    Layout layout_;
    FixedOrder order_;
    graph::BufferRef depths_, chunk_;
};

}  // namespace ir::passes::ldm
