#pragma once

#include "renderers/methods/photon-mapping/tracing.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// Irradiance by density estimation, before any filter, at the splatting resolution.
struct Splat {
    graph::ImageRef irradiance;  ///< "splat.irradiance" RGB: E, W/m²; A: x of the sum of directions to the
                                 ///< light, each weighted by R + G + B of what it adds
    graph::ImageRef direction;   ///< "splat.direction" RG: y and z of that sum, world space
    graph::ImageRef depth;  ///< "splat.depth" r32f: distance along the view axis, m, of the closest of the
                            ///< pixels that the texel stands for; background: infinity
    int divisor = 1;        ///< pixels of the view along a side of a texel: 1, 2 or 4
};

Splat splat_photons(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                    const Parameters& parameters);

std::vector<OutputDescription> splatting_outputs();

}  // namespace ir::methods::photon_mapping
