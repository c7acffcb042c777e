// Builds a band of rows of one map: meshlets are transformed, and triangles that may cover a texel's centre
// go into a queue, from which they are rasterised many at a time.
#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/raytracing/alpha_masks.h"
#include "renderers/passes/vectors/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderers/passes/ldm/host/build_map.cpp"
#include <hwy/foreach_target.h>

#include "renderers/passes/ldm/host/rasterise.inl"

HWY_BEFORE_NAMESPACE();
namespace ir::passes::ldm::HWY_NAMESPACE {
namespace {

class MapBuild {
  public:
    MapBuild(const Meshlets& meshlets, const AlphaMasks& masks, StreamedMap& map, BuildScratch& scratch)
        : meshlets_(meshlets),
          map_(map),
          scratch_(scratch),
          queue_(scratch.queue),
          rasteriser_(meshlets, masks, map, scratch),
          u_(map.frame.u, subtexels, 0.5f),
          v_(map.frame.v, subtexels, 0.5f),
          depth_(map.frame.depth, 1, 0) {}

    void run() {
        rasteriser_.begin();
        const auto all = meshlets_.meshlets.size();
        scratch_.hidden.assign(all + BuildScratch::lanes, 0);
        rasterise(0, meshlets_.occluders);
        rasteriser_.rasterise_queue();
        if (map_.holds == Holds::outermost) rasteriser_.find_hidden(meshlets_.occluders, all);
        rasterise(meshlets_.occluders, meshlets_.opaque);
        rasteriser_.rasterise_queue();
        rasterise(meshlets_.opaque, all);
        rasteriser_.finish();
    }

  private:
    /// Meshlets first … end - 1: the queue holds what is not rasterised yet.
    void rasterise(std::size_t first, std::size_t end) {
        for (auto i = first; i < end; ++i) {
            if (scratch_.hidden[i] || is_outside(i)) continue;
            const auto& meshlet = meshlets_.meshlets[i];
            if (i < meshlets_.opaque)
                queue_triangles<false>(meshlet, nullptr);
            else
                queue_triangles<true>(meshlet, meshlets_.masked_triangles[i - meshlets_.opaque].data());
        }
    }

    bool is_outside(std::size_t meshlet) const {
        if (map_.rows == map_.resolution) return false;
        float middle = map_.frame.v.w, reach = 1;
        for (int axis = 0; axis < 3; ++axis) {
            middle += map_.frame.v[axis] * meshlets_.centre[axis][meshlet];
            reach += std::abs(map_.frame.v[axis]) * meshlets_.half[axis][meshlet];
        }
        return middle + reach < static_cast<float>(map_.first_row) ||
               middle - reach > static_cast<float>(map_.first_row + map_.rows);
    }

    /// A row of the frame, all times `scale`, plus `added`.
    struct Row {
        Floats x, y, z, w;
        Row(const glm::vec4& row, float scale, float added)
            : x(hn::Set(f, row.x * scale)),
              y(hn::Set(f, row.y * scale)),
              z(hn::Set(f, row.z * scale)),
              w(hn::Set(f, row.w * scale + added)) {}
        Floats dot(Floats px, Floats py, Floats pz) const {
            return hn::MulAdd(px, x, hn::MulAdd(py, y, hn::MulAdd(pz, z, w)));
        }
    };

    /// Puts triangles whose box holds a texel's centre into the queue: most do not.
    template <bool masked>
    void queue_triangles(const Meshlet& meshlet, const std::uint32_t* numbers) {
        const auto top = hn::Set(f, static_cast<float>(map_.first_row)),
                   bottom = hn::Set(f, static_cast<float>(map_.first_row + map_.rows));
        for (int first = 0; first < meshlet.triangles; first += lanes) {
            Floats x[3], y[3], z[3];
            for (int k = 0; k < 3; ++k) {
                const auto& corner = meshlet.packs[first / Meshlet::pack_size].corner[k];
                constexpr int within = Meshlet::pack_size - 1;
                const auto px = hn::Load(f, corner[0] + (first & within)),
                           py = hn::Load(f, corner[1] + (first & within)),
                           pz = hn::Load(f, corner[2] + (first & within));
                x[k] = hn::Floor(u_.dot(px, py, pz));
                y[k] = hn::Floor(v_.dot(px, py, pz));
                z[k] = depth_.dot(px, py, pz);
            }
            const auto low = hn::Max(first_centre(min3(y)), top),
                       end = hn::Min(first_centre(max3(y)), bottom);
            const auto live = hn::And(hn::Lt(first_centre(min3(x)), first_centre(max3(x))), hn::Lt(low, end));
            if (hn::AllFalse(f, live)) continue;
            const Packing packing(live);
            const int at = queue_.size;
            for (int k = 0; k < 3; ++k) {
                packing.store(x[k], queue_.x[k] + at);
                packing.store(y[k], queue_.y[k] + at);
                packing.store(z[k], queue_.z[k] + at);
            }
            if constexpr (masked)
                packing.store(hn::LoadU(n, reinterpret_cast<const std::int32_t*>(numbers) + first),
                              queue_.number + at);
            queue_.size += packing.count();
            if (queue_.size <= BuildScratch::queue_size - lanes) continue;
            if constexpr (!masked) rasteriser_.rasterise_queue();
        }
        if constexpr (masked) rasteriser_.rasterise_masked_queue();
    }

    const Meshlets& meshlets_;
    const StreamedMap& map_;
    BuildScratch& scratch_;
    BuildScratch::Queue& queue_;
    Rasteriser rasteriser_;
    Row u_, v_, depth_;  ///< corners are snapped to whole subtexels
};

}  // namespace

void build(const Meshlets& meshlets, const AlphaMasks& masks, StreamedMap& map, BuildScratch& scratch) {
    MapBuild(meshlets, masks, map, scratch).run();
}

}  // namespace ir::passes::ldm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ir::passes::ldm {

HWY_EXPORT(build);

void build_map(const Meshlets& meshlets, const AlphaMasks& masks, const MapFrame& frame, int first_row,
               int rows, StreamedMap& map, BuildScratch& scratch) {
    map.frame = frame;
    map.first_row = first_row;
    map.rows = rows;
    if (map.holds == Holds::sloped_lists) map.slope_of = slope_table(StreamedMap::texel_quanta(frame));
    HWY_DYNAMIC_DISPATCH(build)(meshlets, masks, map, scratch);
}

}  // namespace ir::passes::ldm
#endif
