#pragma once

#include "renderers/methods/deep-screen-space/surfels.h"

namespace ir::methods::deep_screen_space {

/// Declares the output "surfels", of as many elements, which says of each which one it is.
void show_surfels(graph::GraphBuilder& builder, const Surfels& surfels, std::uint64_t reserve,
                  const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
