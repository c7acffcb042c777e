#pragma once

#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// What kernels are tested against, at the splatting resolution.
struct SplatSurfaces {
    graph::ImageRef depth;     ///< "splat.depth", see struct Splat
    graph::ImageRef surfaces;  ///< depth, or at lower resolutions "splat.surfaces"
    graph::ImageRef stencil;   ///< "splat.stencil": for the depth test
    int divisor = 1;
};

/// Declares the pass "surfaces to splat on".
SplatSurfaces splat_surfaces(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, int divisor);

}  // namespace ir::methods::photon_mapping
