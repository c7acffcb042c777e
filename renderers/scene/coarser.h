#pragma once

#include "renderers/scene/world.h"

namespace ir::scene {

/// The same surfaces with fewer triangles: about `detail` (0 … 1) of the opaque ones, simplified by
/// meshoptimizer as far as their topology allows; those with alpha masks stay. Opaque triangles have no
/// materials, and there are no lights and no cameras.
World coarser(const World& world, float detail);

}  // namespace ir::scene
