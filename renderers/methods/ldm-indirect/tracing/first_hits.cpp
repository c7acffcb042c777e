#include "renderers/methods/ldm-indirect/tracing/first_hits.h"

#include <algorithm>

#include "renderers/core/constants.h"
#include "renderers/passes/raytracing/layered_depth_cube.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::ldm_indirect {
namespace {

/// Width of narrow_gap(). Without it light leaks: the lamp of the built-in Cornell box hangs half a
/// millimetre below the ceiling, and through that gap came 0.67 of the right light in addition.
constexpr float narrow_texels = 2;

/// Of narrow_gap().
constexpr float ray_start_of_gap = 1e-3f;

}  // namespace

float narrow_gap(const passes::ldm::Maps& maps) {
    float widest = 0;
    for (const auto& frame : maps.frames)
        widest =
            std::max({widest, glm::length(glm::vec3(frame.step_u)), glm::length(glm::vec3(frame.step_v))});
    return narrow_texels * widest;
}

float ray_start(const passes::ldm::Maps& maps) {
    return ray_start_of_gap * narrow_gap(maps);
}

FirstHits::FirstHits(graph::GraphBuilder& builder, const passes::ldm::Maps& maps,
                     const Parameters& parameters)
    : scene_(parameters.tracer == Tracer::cube ? passes::layered_depth_cube(builder, parameters.cube)
                                               : passes::bvh(builder)),
      has_cube_(parameters.tracer == Tracer::cube),
      start_(ray_start(maps)) {}

FirstHits::Find FirstHits::in(const graph::PassContext& context) const {
    if (has_cube_)
        return [cube = context.object<passes::LayeredDepthCube>(scene_), start = start_](
                   const glm::vec3& position_ws, const glm::vec3& normal_ws, const glm::vec3& direction) {
            auto hit = cube->closest_hit(passes::offset_origin(position_ws, normal_ws) + start * direction,
                                         direction, infinity);
            hit.distance += start;
            return hit;
        };
    return [bvh = context.object<passes::Bvh>(scene_), start = start_](
               const glm::vec3& position_ws, const glm::vec3& normal_ws, const glm::vec3& direction) {
        return bvh->closest_hit(passes::offset_origin(position_ws, normal_ws), direction, start, infinity);
    };
}

}  // namespace ir::methods::ldm_indirect
