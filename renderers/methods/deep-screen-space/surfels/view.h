#pragma once

#include <algorithm>
#include <array>

#include "renderers/core/constants.h"
#include "renderers/core/fields.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/scene/view.h"

namespace ir::methods::deep_screen_space {

/// Constants of ideal.glsl: the size that surfels should have.
struct Ideal {
    glm::vec3 ideal_eye_ws, ideal_axis_ws;
    float ideal_radius, ideal_corner_cosine, ideal_nearest;
    IR_FIELDS(ideal_eye_ws, ideal_axis_ws, ideal_radius, ideal_corner_cosine, ideal_nearest)
};
Ideal ideal(const scene::View& view, const Parameters& parameters);

inline bool is_parallel(const Ideal& ideal) {
    return ideal.ideal_axis_ws == glm::vec3(0);
}

/// As ideal.glsl.
inline float ideal_distance(const Ideal& ideal, glm::vec3 position_ws) {
    const auto offset = position_ws - ideal.ideal_eye_ws;
    return std::max({glm::dot(offset, ideal.ideal_axis_ws), ideal.ideal_corner_cosine * glm::length(offset),
                     ideal.ideal_nearest});
}
/// By how much the ideal radius is larger there than at 1 m; of parallel rays it is the same everywhere.
inline float ideal_scale(const Ideal& ideal, float distance) {
    return is_parallel(ideal) ? 1 : distance;
}
inline float ideal_area_at(const Ideal& ideal, float distance) {
    const float radius = ideal.ideal_radius * ideal_scale(ideal, distance);
    return pi * radius * radius;
}
inline float ideal_area(const Ideal& ideal, glm::vec3 position_ws) {
    return ideal_area_at(ideal, ideal_distance(ideal, position_ws));
}

/// Planes of split.comp: the view's frustum, with `reach` (m) to all sides.
struct Frustum {
    std::array<glm::vec4, 6> frustum;  ///< unit normals inwards
    bool culls;
    float margin;
    IR_FIELDS(frustum, culls, margin)
};
Frustum frustum(const scene::View& view, float reach, const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
