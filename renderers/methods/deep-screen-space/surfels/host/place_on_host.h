#pragma once

#include "renderers/methods/deep-screen-space/surfels/steps.h"

namespace ir::methods::deep_screen_space {

/// Surfels placed systematically by the host's threads: what cut_patches() and place() make on the device,
/// but for rounding, which may move all surfels behind a patch along the curve. `patches` has counters alone.
Placed place_on_host(graph::GraphBuilder& builder, float reach, std::uint64_t reserve,
                     const Parameters& parameters, const std::string& fingerprint);

}  // namespace ir::methods::deep_screen_space
