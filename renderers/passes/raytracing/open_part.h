#pragma once

#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/scene/frame.h"

namespace ir::passes {

/// Part of a diffuse surface's reflection that gets farther than `reach` (m), by few rays. Maps, discs and
/// the like that resolve no gaps of that width compute it for surfaces that a source before them lights: what
/// a lamp's back sends up to a ceiling half a millimetre away would come down through the lamp. `number`: of
/// the first pair of random numbers.
inline float open_part(const Bvh& bvh, glm::vec3 position_ws, glm::vec3 geometric_normal_ws, float reach,
                       const PathSampler& random, std::uint32_t number) {
    constexpr std::uint32_t rays = 16;
    const auto around = scene::frame_around(geometric_normal_ws);
    const auto origin = offset_origin(position_ws, geometric_normal_ws);
    int open = 0;
    for (std::uint32_t i = 0; i < rays; ++i) {
        const auto direction = glm::normalize(around * sample_cosine_ts(random.pair(number + i)));
        open += !bvh.occluded(origin, direction, 0, reach);
    }
    return static_cast<float>(open) / rays;
}

}  // namespace ir::passes
