#pragma once

#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {

/// "bounce.incoming" by the host's threads, as resolve.comp has it: what the winners send.
void resolve_light_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible,
                           const std::string& batch);

}  // namespace ir::methods::deep_screen_space
