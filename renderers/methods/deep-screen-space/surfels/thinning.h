#pragma once

#include "renderers/methods/deep-screen-space/surfels/fine.h"

namespace ir::methods::deep_screen_space {

/// Declares "surfels.records" with the passes that keep some of the fine ones, unlit. [Nalbach15 fig. 6 c]
Surfels thin(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Growing& fine,
             std::uint64_t reserve, const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
