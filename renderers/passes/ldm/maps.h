#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/passes/ldm/directions.h"
#include "renderers/scene/scene.h"
#include "shaders/passes/ldm/frames.glsl.h"

namespace ir::passes::ldm {

/// Depths are 16-bit numbers, quanta, along the map's direction. The scene's depths lie this far from the
/// ends of that range, so that tolerances do not leave it.
inline constexpr int depth_margin = 64;
inline constexpr int max_depth = 65535;
/// Vertices are snapped to this fraction of a texel before they are rasterised, as OpenGL's rasterisers do.
inline constexpr int subtexels = 256;

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
