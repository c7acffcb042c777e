#pragma once

#include "renderers/methods/deep-screen-space/surfels.h"
#include "renderers/methods/deep-screen-space/surfels/packing.h"

namespace ir::methods::deep_screen_space {

/// Parts of triangles that the tessellator divides, in the order of triangles; struct Patch of patch.glsl.
struct Patches {
    Growing list;                 ///< "surfels.patches.list"
    Growing points;               ///< "surfels.points": how many points the tessellator makes before each
    graph::CounterRef triangles;  ///< that are not culled
};

/// Declares the passes that cull triangles and split those that are too large, and add to `fine_count` how
/// many points that makes. [Nalbach15 fig. 6 a]
Patches cut_patches(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                    graph::CounterRef fine_count, float reach, std::uint64_t reserve,
                    const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
