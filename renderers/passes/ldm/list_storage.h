#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// Pre-sorted per-pixel singly linked lists. [Aalund15 §3, Lefebvre14]
class ListStorage : public Storage {
  public:
    ListStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {heads_, nodes_}; }
    std::vector<graph::CounterRef> counters() const override { return {nodes_requested_}; }
    void begin_batch(const graph::PassContext& context) const override;
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 8; }

  protected:
    Layout layout_;
    graph::BufferRef heads_, nodes_;
    graph::CounterRef nodes_requested_;
};

}  // namespace ir::passes::ldm
