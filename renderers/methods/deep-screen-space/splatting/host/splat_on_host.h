#pragma once

#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {

/// Rays of pixels against ray-tracing scenes of discs, in place of splats: the same winners, but for rounding
/// at the edges of discs. Declares and writes `nearest`, `hit_level` and the result, "bounce.distance"; and
/// `depth` and `winner`, which run only for those who look at them.
graph::ImageRef splat_on_host(graph::GraphBuilder& builder, VisibleSplats& visible);

}  // namespace ir::methods::deep_screen_space
