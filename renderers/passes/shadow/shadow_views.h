#pragma once

#include <vector>

#include "renderers/core/fields.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// One layer of "shadow.maps" as struct ShadowView of shaders/passes/shadow/shadow.glsl. The point at x, y in
/// normalised device coordinates and t metres along the axis is origin + t forward + s (x right + y up), s =
/// t for a perspective and 1 for an orthographic map. Maps hold t / far.
struct ShadowViewData {
    glm::mat4 clip_from_world;
    glm::vec3 origin;
    float perspective;  ///< 1 or 0
    glm::vec3 right;
    float far;  ///< m
    glm::vec3 up;
    int light;  ///< index into World::lights
    glm::vec3 forward;
    float near;  ///< m
    IR_FIELDS(clip_from_world, origin, perspective, right, far, up, light, forward, near)
};

/// The views of all lights in order of layer. Perspective for spots (the outer cone) and the six faces of
/// point lights (+x, -x, +y, -y, +z, -z); orthographic about the world's bounds for directional lights.
std::vector<ShadowViewData> shadow_views(const scene::World& world, int resolution);

}  // namespace ir::passes
