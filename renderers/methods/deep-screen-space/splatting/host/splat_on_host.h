#pragma once

#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {

/// Rays of pixels against ray-tracing scenes of discs, in place of splats: the same winners, but for rounding
/// at the edges of discs. Writes `nearest`, `hit_level` and the distance; and `depth` and `winner`, which run
/// only for those who look at them.
void splat_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch);

}  // namespace ir::methods::deep_screen_space
