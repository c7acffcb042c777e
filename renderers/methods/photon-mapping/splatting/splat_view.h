#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/parameters.h"

namespace ir::methods::photon_mapping {

/// Pixels of the view along a side of a texel.
int divisor_of(SplatResolution resolution);

/// Texels of a picture of this view. The last of a row may reach beyond the picture.
glm::ivec2 texels_of(const scene::View& view, int divisor);

/// Takes world space to the clip space of those texels.
glm::mat4 clip_from_world(const scene::View& view, int divisor);

/// Share of the picture that a square with so many pixels a side has, times 4 tan(α_x/2) tan(α_y/2), or times
/// the height and width (m) of a parallel view: c_tile.  [Smal19 §6.1.1]
float area_constant(const scene::View& view, int pixels);

/// Sets the uniforms of shaders/methods/photon-mapping/splatting/splat_view.glsl.
void set_splat_view(const gl::Program& program, const graph::FrameInputs& inputs, int divisor);

/// Sets the uniforms of photon_kernel.glsl beside it, those of the view included.
void set_kernel(const gl::Program& program, const graph::FrameInputs& inputs, const Parameters& parameters,
                float power_unit);

}  // namespace ir::methods::photon_mapping
