#pragma once

#include "renderers/core/fields.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/methods/ldm-indirect/parameters.h"

namespace ir::methods::ldm_indirect {

/// Constants of splatting/ellipse.glsl.
struct Ellipses {
    glm::vec3 eye_ws, view_axis_ws;
    float near_plane, pixel_size, splat_size, topological_bias, min_axis_pixels, longest_axis;
    bool perspective;
    IR_FIELDS(eye_ws, view_axis_ws, near_plane, pixel_size, splat_size, topological_bias, min_axis_pixels,
              longest_axis, perspective)
};

inline Ellipses ellipses(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto& view = inputs.view;
    return {.eye_ws = view.eye_ws,
            .view_axis_ws = -glm::vec3(glm::transpose(view.view_from_world)[2]),
            .near_plane = view.near_plane,
            .pixel_size = pixel_size(view),
            .splat_size = parameters.splat_size,
            .topological_bias = parameters.topological_bias,
            .min_axis_pixels = parameters.min_axis_pixels,
            .longest_axis = longest_axis(parameters, *inputs.world),
            .perspective = view.clip_from_view[3][3] == 0};
}

}  // namespace ir::methods::ldm_indirect
