#pragma once

#include "renderers/passes/ldm/list_storage.h"

namespace ir::passes::ldm {

/// Per-pixel singly linked lists in order of arrival, each sorted when a chunk is complete. What queries read
/// is what ListStorage makes. [Yang10]
class SortedListStorage : public ListStorage {
  public:
    SortedListStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::vector<graph::BufferRef> scratch() const override { return {deep_texels_, successors_}; }
    std::vector<graph::CounterRef> counters() const override {
        return {nodes_requested_, successors_requested_};
    }
    bool needs_arrivals() const override { return true; }
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;

  private:
    graph::BufferRef deep_texels_, successors_;
    graph::CounterRef successors_requested_;
};

}  // namespace ir::passes::ldm
