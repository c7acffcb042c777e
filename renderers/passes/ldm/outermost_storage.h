#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// The outermost two depths of each texel, packed into one word: no lists, and no sorting. That is all that
/// hits at any distance take by the rule tangent-plane: a direction is open where nothing of its texel lies
/// beyond the point.
class OutermostStorage : public Storage {
  public:
    OutermostStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext&) const override {
        return {{"LDM_OUTERMOST", "1"}};
    }
    std::vector<graph::BufferRef> buffers() const override { return {texels_}; }
    std::vector<graph::CounterRef> counters() const override { return {between_}; }
    void begin_batch(const graph::PassContext& context) const override;
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    std::uint64_t table_bytes(const graph::PassContext&) const override { return 4 * batch_texels(); }
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t batch_texels() const {
        return static_cast<std::uint64_t>(layout_.batch_maps) * layout_.map_texels();
    }

    Layout layout_;
    graph::BufferRef texels_;
    graph::CounterRef between_;
};

}  // namespace ir::passes::ldm
