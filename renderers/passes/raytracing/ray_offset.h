#pragma once

#include <algorithm>
#include <glm/glm.hpp>

#include "shaders/passes/raytracing/ray_offset.glsl.h"

/// As ray_offset.glsl.
namespace ir::passes {

inline float ray_offset(glm::vec3 position_ws) {
    const auto size = glm::abs(position_ws);
    return min_ray_offset_m + relative_ray_offset * std::max({size.x, size.y, size.z});
}

inline glm::vec3 offset_origin(glm::vec3 position_ws, glm::vec3 geometric_normal_ws) {
    return position_ws + ray_offset(position_ws) * geometric_normal_ws;
}

}  // namespace ir::passes
