#pragma once

#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {

/// "bounce.incoming" by the host's threads, as resolve.comp has it: what the winners send.
graph::ImageRef resolve_light_on_host(graph::GraphBuilder& builder, const passes::ShadowMaps& shadow,
                                      const VisibleSplats& visible, graph::ImageRef distance);

}  // namespace ir::methods::deep_screen_space
