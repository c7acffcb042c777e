#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// One hash table for all texels of a batch: coherent hashing, with open addressing by age. [Lefebvre13,
/// Lefebvre14 "PreOpen"] Texel t looks for its entry of age a = 1, 2, … at cell (t + offset of a) mod size,
/// so that neighbouring texels look at neighbouring cells, and cell and age tell the texel: an entry is 32
/// bits, age << 16 | nearness. A cell keeps the largest entry that comes (Robin Hood: the oldest, and of one
/// texel the nearest) and hands on the other, so each texel's depths are sorted by age as soon as they are
/// in. A table of each texel's largest age ends its searches.
///
/// The table grows when it would be fuller than 9/10. What is in excess until then is left out, the frame is
/// incomplete, and runs again.
class HashStorage : public Storage {
  public:
    HashStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {ages_, cells_}; }
    std::vector<graph::CounterRef> counters() const override { return {cells_requested_, max_age_}; }
    void begin_batch(const graph::PassContext& context) const override;
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    /// The table has no part that is spare: empty cells are what keeps searches short.
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t batch_texels() const { return layout_.batch_maps * layout_.map_texels(); }
    /// Fewer cells than texels could not tell texels by cell and age.
    bool is_too_small(const graph::PassContext& context) const {
        return context.capacity(cells_) < batch_texels();
    }

    Layout layout_;
    graph::BufferRef ages_, cells_;
    graph::CounterRef cells_requested_, max_age_;
};

}  // namespace ir::passes::ldm
