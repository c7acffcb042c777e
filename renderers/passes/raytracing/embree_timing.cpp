#include "renderers/passes/raytracing/embree_timing.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/core/threads.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::passes {
namespace {

constexpr std::size_t packet_rays = 16;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Count {
    std::uint64_t rays = 0, blocked = 0;
};

/// All rays of up to sixteen consecutive positions, one packet per direction.
class Group {
  public:
    Group(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals, float max_distance)
        : normals_(normals) {
        for (std::size_t i = 0; i < packet_rays; ++i) {
            packet_.active[i] = 0;
            const auto origin = i < positions.size() ? offset_origin(positions[i], normals[i]) : glm::vec3(0);
            packet_.ox[i] = origin.x, packet_.oy[i] = origin.y, packet_.oz[i] = origin.z;
            packet_.near[i] = 0;
            packet_.far[i] = max_distance;
        }
    }

    Count trace(const Bvh& bvh, glm::vec3 direction) {
        Count count;
        for (std::size_t i = 0; i < normals_.size(); ++i) {
            const bool above = glm::dot(normals_[i], direction) > 0;
            packet_.active[i] = above ? -1 : 0;
            count.rays += above;
        }
        if (count.rays == 0) return count;
        for (std::size_t i = 0; i < packet_rays; ++i) {
            packet_.dx[i] = direction.x, packet_.dy[i] = direction.y, packet_.dz[i] = direction.z;
        }
        count.blocked = std::isinf(packet_.far[0])
                            ? static_cast<std::uint64_t>(std::popcount(bvh.occluded16(packet_, true)))
                            : closest(bvh);
        return count;
    }

  private:
    std::uint64_t closest(const Bvh& bvh) const {
        float distances[packet_rays];
        bvh.closest16(packet_, true, distances);
        return static_cast<std::uint64_t>(std::count_if(std::begin(distances), std::end(distances),
                                                        [](float d) { return !std::isinf(d); }));
    }

    std::span<const glm::vec3> normals_;
    Bvh::Packet16 packet_;
};

Count trace_all(const Bvh& bvh, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                std::span<const glm::vec3> directions, float max_distance, const CancelToken& cancel) {
    tbb::enumerable_thread_specific<Count> counts;
    const auto groups = (positions.size() + packet_rays - 1) / packet_rays;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, groups), [&](const auto& range) {
        auto& count = counts.local();
        for (auto g = range.begin(); g != range.end(); ++g) {
            if (cancel.is_cancelled()) return;
            const auto first = g * packet_rays, size = std::min(packet_rays, positions.size() - first);
            Group group(positions.subspan(first, size), normals.subspan(first, size), max_distance);
            for (const auto& direction : directions) {
                const auto traced = group.trace(bvh, direction);
                count.rays += traced.rays;
                count.blocked += traced.blocked;
            }
        }
    });
    cancel.check();
    Count total;
    for (const auto& count : counts) total.rays += count.rays, total.blocked += count.blocked;
    return total;
}

}  // namespace

EmbreeTiming time_embree_ao(const scene::Scene& scene, const scene::World& world,
                            std::span<const glm::vec3> positions_ws, std::span<const glm::vec3> normals_ws,
                            std::span<const glm::vec3> directions_ws, float max_distance, int threads,
                            const CancelToken& cancel) {
    if (positions_ws.size() != normals_ws.size()) {
        throw Error("ray tracing benchmark: as many normals as positions are needed");
    }
    EmbreeTiming timing;
    tbb::task_arena arena(arena_size(threads));
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh(scene, world, threads, Bvh::Edges::fast);
    timing.build_ms = milliseconds_since(start);
    const auto traced_from = std::chrono::steady_clock::now();
    cancel.check();
    const auto count = arena.execute(
        [&] { return trace_all(bvh, positions_ws, normals_ws, directions_ws, max_distance, cancel); });
    timing.trace_ms = milliseconds_since(traced_from);
    timing.rays = count.rays;
    timing.blocked = count.blocked;
    timing.bytes = bvh.bytes();
    return timing;
}

}  // namespace ir::passes
