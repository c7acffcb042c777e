#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/passes/ldm/directions.h"
#include "renderers/scene/scene.h"

namespace ir::passes::ldm {

/// Depths are 16-bit numbers, quanta, along the map's direction. The scene's depths lie this far from the
/// ends of that range, so that tolerances do not leave it.
inline constexpr int depth_margin = 64;
inline constexpr int max_depth = 65535;
/// Vertices are snapped to this fraction of a texel before they are rasterised, as OpenGL's rasterisers do.
inline constexpr int subtexels = 256;

/// The orthographic view of one map, as the shaders read it (shaders/passes/ldm/frames.glsl). A point P is at
/// texel coordinates (dot(P, u.xyz) + u.w, dot(P, v.xyz) + v.w) and at depth dot(P, depth.xyz) + depth.w
/// quanta; depth grows along the map's direction.
struct MapFrame {
    glm::vec4 u, v, depth;
    glm::vec4 step_u, step_v;  ///< world-space vectors that cross one texel; w 0
    glm::vec4 direction;       ///< unit length; w: metres per quantum
    IR_FIELDS(u, v, depth, step_u, step_v, direction)
};

/// The frame of the map along `direction` (unit length) with resolution² texels: of the rectangles with a
/// side along a projected axis that enclose the projected bounds the smallest, which is the smallest of all.
/// Extents that are (almost) zero are widened so that texels stay resolvable in float.
MapFrame fit_frame(const glm::dvec3& direction, const scene::Bounds& bounds, int resolution);

/// Frames of directions[first …], turned by `rotation`.
std::vector<MapFrame> fit_frames(const std::vector<Direction>& directions, const glm::dmat3& rotation,
                                 const scene::Bounds& bounds, int resolution);

/// World-space centre of a texel at a depth in quanta.
glm::dvec3 texel_centre_ws(const MapFrame& frame, int column, int row, double depth);

}  // namespace ir::passes::ldm
