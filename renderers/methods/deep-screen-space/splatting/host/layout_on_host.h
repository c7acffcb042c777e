#pragma once

#include "renderers/methods/deep-screen-space/splatting.h"

namespace ir::methods::deep_screen_space {

/// Declares the pass "framebuffer layout" on the host's threads: what layout.comp writes, bit by bit.
void lay_out_on_host(graph::GraphBuilder& builder, const Hierarchy& hierarchy, unsigned seed);

}  // namespace ir::methods::deep_screen_space
