#pragma once

#include "renderers/methods/photon-mapping/splatting/stored.h"

namespace ir::methods::photon_mapping {

/// Declares "splat.tiles" and the pass that counts the photons of each tile.
graph::ImageRef count_tiles(graph::GraphBuilder& builder, const StoredPhotons& photons,
                            const Parameters& parameters);

}  // namespace ir::methods::photon_mapping
