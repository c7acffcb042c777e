#pragma once

#include <glm/glm.hpp>

#include "renderers/core/fields.h"
#include "shaders/passes/shadow/shadow.glsl.h"

namespace ir::passes {

/// Constants of triangles.vert and shaders/passes/shadow/texel.glsl.
struct TexelConstants {
    glm::mat4 clip_from_world;
    glm::vec3 eye_ws, view_right_ws, view_up_ws, view_axis_ws;
    float perspective, far, resolution;
    int material_index;
    IR_FIELDS(clip_from_world, eye_ws, view_right_ws, view_up_ws, view_axis_ws, perspective, far, resolution,
              material_index)
};
inline TexelConstants texel_constants(const ShadowViewData& view, int resolution) {
    return {.clip_from_world = view.clip_from_world,
            .eye_ws = view.origin_ws,
            .view_right_ws = view.right_ws,
            .view_up_ws = view.up_ws,
            .view_axis_ws = view.forward_ws,
            .perspective = view.perspective,
            .far = view.far,
            .resolution = static_cast<float>(resolution),
            .material_index = 0};
}

}  // namespace ir::passes
