#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/ldm/host/host_scene.h"

namespace ir::passes::ldm {

/// Maps of outermost depths that stand from frame to frame while the world and the maps' frames do: the first
/// ones of all, as many as there is room for. Graphs that share them may build them at once.
class KeptMaps {
  public:
    /// However much the memory budget leaves over.
    static constexpr std::uint64_t max_bytes = 32 << 20;

    /// How many maps with such a layout fit into so many bytes.
    static int count(const Layout& layout, std::uint64_t room = max_bytes) {
        return static_cast<int>(
            std::min<std::uint64_t>(layout.maps, std::min(room, max_bytes) / map_bytes(layout.resolution)));
    }

    KeptMaps(const Layout& layout, std::uint64_t room)
        : rows_(StreamedMap::band_rows(layout.resolution)),
          count_(static_cast<std::size_t>(count(layout, room))),
          bands_(bands_of(layout.resolution) * count_, StreamedMap(layout.resolution, Holds::outermost)),
          fragments_(bands_.size()),
          built_(std::make_unique<std::once_flag[]>(bands_.size())) {}

    std::int64_t count() const { return static_cast<std::int64_t>(count_); }
    std::uint64_t bytes() const { return count_ == 0 ? 0 : count_ * map_bytes(bands_.front().resolution); }

    /// Builds the band from `row` on of a map where that was not done before. Its fragments are counted in
    /// `scratch` as if they were made now; `built` counts maps.
    void build(const HostScene& scene, const Maps& maps, std::int64_t map, int row, BuildScratch& scratch,
               std::uint64_t& built);
    /// The bands from `row` on of maps first … end - 1.
    std::span<const StreamedMap> bands(std::int64_t first, std::int64_t end, int row) const {
        return std::span(bands_).subspan(place(first, row), static_cast<std::size_t>(end - first));
    }

  private:
    std::size_t place(std::int64_t map, int row) const {
        return static_cast<std::size_t>(row / rows_) * count_ + static_cast<std::size_t>(map);
    }
    static std::size_t bands_of(int resolution) {
        const int rows = StreamedMap::band_rows(resolution);
        return static_cast<std::size_t>((resolution + rows - 1) / rows);
    }
    static std::uint64_t map_bytes(int resolution) {
        const int rows = StreamedMap::band_rows(resolution);
        auto bytes = bands_of(resolution) * sizeof(StreamedMap);
        for (int row = 0; row < resolution; row += rows)
            bytes += StreamedMap::outermost_bytes(resolution, std::min(rows, resolution - row));
        return bytes;
    }
    int rows_;
    std::size_t count_;
    std::vector<StreamedMap> bands_;  ///< those of the same rows together
    std::vector<std::uint64_t> fragments_;
    std::unique_ptr<std::once_flag[]> built_;
};

/// Declares the object "ldm.kept" and its pass, which makes room; absent where nothing may stand still.
graph::ObjectRef declare_kept(graph::GraphBuilder& builder, const std::shared_ptr<const Maps>& maps);

}  // namespace ir::passes::ldm
