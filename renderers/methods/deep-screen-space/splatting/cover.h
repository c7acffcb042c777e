#pragma once

#include "renderers/methods/deep-screen-space/splatting/splats.h"

namespace ir::methods::deep_screen_space {

/// Declares "splats.cover", rg32f stack of the hierarchy's size, a layer for each sample and level: how many
/// splats cover each place, and how many of them have its surface within reach. It is drawn only for those
/// who look at it. `weight` is what a splat counts, as GLSL; empty: 1.
graph::ImageRef count_cover(graph::GraphBuilder& builder, const Splats& splats,
                            const std::string& weight = {});

}  // namespace ir::methods::deep_screen_space
