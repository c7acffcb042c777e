#pragma once

#include "renderers/methods/deep-screen-space/surfels.h"

namespace ir::methods::deep_screen_space {

/// Declares the pass that lights the surfels. [Nalbach15 fig. 6 d]
void shade(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::ShadowMaps& shadow,
           const Surfels& surfels, const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
