#pragma once

#include <array>

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

/// Planes of split.comp: the view's frustum, with `reach` (m) to all sides.
struct Frustum {
    std::array<glm::vec4, 6> frustum;  ///< unit normals inwards
    bool culls;
    float margin;
    IR_FIELDS(frustum, culls, margin)
};
Frustum frustum(const scene::View& view, float reach, const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
