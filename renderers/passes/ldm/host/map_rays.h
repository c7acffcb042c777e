#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "renderers/core/progress.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/ldm/host/host_scene.h"

namespace ir::passes::ldm {

/// A ray that starts on a surface and goes along a map's direction, or against it: out of the surface.
struct MapRay {
    glm::vec3 position_ws, normal_ws;  ///< the normal is geometric, of unit length
    std::uint32_t map = 0;
    bool forward = true;  ///< along the map's direction
};

/// What a map has in the way of a ray.
struct MapHit {
    float distance = std::numeric_limits<float>::infinity();  ///< m; infinite: nothing
    glm::vec3 node_ws{0};  ///< the entry, at its texel's centre, where something is exactly
};

/// Finds the first hits of rays that start anywhere. Maps are streamed: a thread builds one, asks it for its
/// rays, and forgets it. Those without rays are not built. [Aalund15 §3.1]
class MapRays {
  public:
    MapRays(MapsPointer maps, const SelfHitRule& rule, int threads);

    std::int64_t first_slice() const { return static_cast<std::int64_t>(workers_.size()); }
    /// What trace() is about; the rays stay the caller's.
    void sort(std::span<const MapRay> rays);
    /// The first hits of the rays of maps first … end - 1; `hits` has one for each of all rays. The same with
    /// any number of threads.
    void trace(const HostScene& scene, std::int64_t first, std::int64_t end, const CancelToken& cancel,
               std::span<MapHit> hits);

  private:
    struct Worker {
        explicit Worker(int resolution) : map(resolution, Holds::lists) {}
        StreamedMap map;
        BuildScratch scratch;
    };
    void trace_map(const HostScene& scene, Worker& worker, std::size_t map, std::span<MapHit> hits) const;

    MapsPointer maps_;
    SelfHitRule rule_;
    tbb::task_arena arena_;
    std::vector<Worker> workers_;
    std::span<const MapRay> rays_;
    std::vector<std::size_t> starts_, order_;  ///< the rays of each map
};

}  // namespace ir::passes::ldm
