#include "renderers/passes/ldm/host/map_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "renderers/passes/ldm/host/first_hit.h"

namespace ir::passes::ldm {

MapRays::MapRays(MapsPointer maps, const SelfHitRule& rule, int threads)
    : maps_(std::move(maps)),
      rule_(rule),
      arena_(threads),
      workers_(static_cast<std::size_t>(std::min(threads, maps_->layout.maps)),
               Worker(maps_->layout.resolution)) {}

void MapRays::sort(std::span<const MapRay> rays) {
    rays_ = rays;
    starts_.assign(maps_->frames.size() + 1, 0);
    for (const auto& ray : rays) ++starts_[ray.map + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    auto next = starts_;
    order_.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) order_[next[rays[i].map]++] = i;
}

void MapRays::trace(const HostScene& scene, std::int64_t first, std::int64_t end, const CancelToken& cancel,
                    std::span<MapHit> hits) {
    std::atomic<std::int64_t> next{first};
    arena_.execute([&] {
        tbb::parallel_for(
            std::size_t{0}, workers_.size(),
            [&](std::size_t i) {
                for (auto map = next++; map < end && !cancel.is_cancelled(); map = next++)
                    trace_map(scene, workers_[i], static_cast<std::size_t>(map), hits);
            },
            tbb::simple_partitioner());
    });
    cancel.check();
}

void MapRays::trace_map(const HostScene& scene, Worker& worker, std::size_t map,
                        std::span<MapHit> hits) const {
    const auto asked = std::span(order_).subspan(starts_[map], starts_[map + 1] - starts_[map]);
    if (asked.empty()) return;
    const int resolution = maps_->layout.resolution, rows = StreamedMap::band_rows(resolution);
    const auto& frame = maps_->frames[map];
    for (int row = 0; row < resolution; row += rows) {
        build_map(scene.meshlets, scene.masks, frame, row, std::min(rows, resolution - row), worker.map,
                  worker.scratch);
        const PointTracer tracer(worker.map, rule_);
        for (const auto i : asked) {
            const auto& ray = rays_[i];
            const auto hit = tracer.trace(ray.position_ws, ray.normal_ws, ray.forward);
            if (!hit.is_here || !hit.is_found) continue;
            hits[i] = {std::max(hit.distance, 0.0f) * frame.direction.w,
                       glm::vec3(texel_centre_ws(frame, hit.column, hit.row, hit.entry))};
        }
    }
}

}  // namespace ir::passes::ldm
