#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "renderers/core/progress.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// One cold run of ambient occlusion with a ray tracer, to set beside layered depth maps.
struct EmbreeTiming {
    double build_ms = 0;  ///< BVH, build quality medium
    double trace_ms = 0;
    std::uint64_t rays = 0, blocked = 0;
    std::uint64_t bytes = 0;  ///< of the BVH
};

/// Builds a BVH and traces, from each position and for each of the 2N directions on its normal's side (N
/// where the directions come in ± pairs), a ray. Without limit of distance (infinity) any hit answers; within
/// `max_distance` metres it is the closest one, on whose distance smooth visibility depends. Rays are grouped
/// in Embree's favour: 16 consecutive positions in one direction, marked as coherent; so let neighbours stand
/// together. Unit geometric normals; a zero normal (background) gets no rays. `threads` 0 = all. Throws
/// Cancelled.
EmbreeTiming time_embree_ao(const scene::Scene& scene, const scene::World& world,
                            std::span<const glm::vec3> positions_ws, std::span<const glm::vec3> normals_ws,
                            std::span<const glm::vec3> directions_ws, float max_distance, int threads,
                            const CancelToken& cancel = {});

}  // namespace ir::passes
