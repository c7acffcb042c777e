#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// Depths of 16 bits in a page. On Sponza pages of 4 and of 6 take the least memory (4.07 and 4.08 bytes per
/// fragment with heads; of 2 4.78, of 8 4.32); with 6 there are fewer links to follow, and a page is four
/// words.
inline constexpr int page_depths = 6;

/// Paged per-pixel singly linked lists, sorted when a chunk is complete. The number of a fragment at its
/// texel is known before any is stored, so that pages are linked in a step of their own, without locks.
/// [Crassin10]
class PageStorage : public Storage {
  public:
    PageStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {heads_, pages_}; }
    std::vector<graph::BufferRef> scratch() const override { return {deep_texels_, ranks_}; }
    std::vector<graph::CounterRef> counters() const override { return {pages_requested_, ranks_requested_}; }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext& context) const override;
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 0; }  // pages are counted one by one

  private:
    Layout layout_;
    graph::BufferRef heads_, pages_, deep_texels_, ranks_;
    graph::CounterRef pages_requested_, ranks_requested_;
};

}  // namespace ir::passes::ldm
