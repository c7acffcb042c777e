#pragma once

#include "renderers/core/fields.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/methods/ldm-indirect/parameters.h"

namespace ir::methods::ldm_indirect {

/// Constants of landing.glsl.
struct LandingConstants {
    glm::mat4 clip_from_world;
    float splat_size, topological_bias, longest_axis, shortest_axis, nearest_w;
    IR_FIELDS(clip_from_world, splat_size, topological_bias, longest_axis, shortest_axis, nearest_w)
};

inline LandingConstants landing_constants(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto& view = inputs.view;
    return {.clip_from_world = view.clip_from_world(),
            .splat_size = parameters.splat_size,
            .topological_bias = parameters.topological_bias,
            .longest_axis = longest_axis(parameters, *inputs.world),
            .shortest_axis = parameters.min_axis_pixels * pixel_size(view),
            .nearest_w = view.clip_from_view[3][3] == 0 ? view.near_plane : 1.0f};
}

}  // namespace ir::methods::ldm_indirect
