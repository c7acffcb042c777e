#pragma once

#include "renderers/passes/ldm/storage.h"

namespace ir::passes::ldm {

/// Depth peeling: plane by plane the nearest fragment of each texel beyond that of the plane before, as many
/// planes for each chunk of maps as its deepest texel has layers. [Everitt01]
///
/// DEVIATION [Everitt01]: a plane is a pass over the chunk's fragments, not another drawing of the scene, so
/// that all storages hold the same fragments; and the order of arrival tells fragments of equal depth apart,
/// which peeling by depth alone would lose.
class PeelStorage : public Storage {
  public:
    PeelStorage(graph::GraphBuilder& builder, const Layout& layout);

    std::map<std::string, std::string> defines(const graph::PassContext& context) const override;
    std::vector<graph::BufferRef> buffers() const override { return {chunks_, planes_}; }
    std::vector<graph::BufferRef> scratch() const override { return {layers_}; }
    std::vector<graph::CounterRef> counters() const override {
        return {layers_requested_, planes_requested_};
    }
    bool needs_arrivals() const override { return true; }
    void begin_batch(const graph::PassContext& context) const override;
    void store(const graph::PassContext& context, const FragmentList& list,
               const Chunk& chunk) const override;
    /// Planes have as many texels as a chunk of maps, whatever the chunk has. They are counted by chunk, as
    /// their number is only known then.
    std::uint64_t table_bytes(const graph::PassContext& context) const override;
    double fragment_bytes() const override { return 0; }

  private:
    std::uint64_t batch_chunks() const {
        return static_cast<std::uint64_t>((layout_.batch_maps + layout_.chunk_maps - 1) / layout_.chunk_maps);
    }
    std::uint64_t plane_texels() const { return layout_.chunk_maps * layout_.map_texels(); }

    Layout layout_;
    graph::BufferRef chunks_, planes_, layers_;
    graph::CounterRef layers_requested_, planes_requested_;
};

}  // namespace ir::passes::ldm
