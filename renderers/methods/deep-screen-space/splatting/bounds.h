#pragma once

#include "renderers/methods/deep-screen-space/splatting.h"

namespace ir::methods::deep_screen_space {

/// Declares the pass "bounds of positions" and `hierarchy.min` and `max`, down to one texel. A pixel
/// (x, y) lies on mip level m below the texel (min(x >> m, width_m - 1), …). [Nalbach15 §4.3]
void bound_positions(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, Hierarchy& hierarchy);

}  // namespace ir::methods::deep_screen_space
