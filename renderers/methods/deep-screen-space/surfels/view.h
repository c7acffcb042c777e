#pragma once

#include "renderers/gl/program.h"
#include "renderers/graph/frame_inputs.h"
#include "renderers/methods/deep-screen-space/parameters.h"

namespace ir::methods::deep_screen_space {

/// Sets the uniforms of ideal.glsl: the size that surfels should have.
void set_ideal(const gl::Program& program, const graph::FrameInputs& inputs, const Parameters& parameters);

/// Sets the planes of split.comp: the view's frustum, with `reach` (m) to all sides.
void set_frustum(const gl::Program& program, const graph::FrameInputs& inputs, float reach,
                 const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
