#pragma once

#include "renderers/methods/photon-mapping/splatting/draw_kernels.h"
#include "renderers/methods/photon-mapping/splatting/stored.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// Declares "splat.tiles" and the pass that counts the photons of each tile.
graph::ImageRef count_tiles(graph::GraphBuilder& builder, const StoredPhotons& photons,
                            const Parameters& parameters);

/// Declares "photons.overlay": the photons over the picture.  [Smal19 fig. 8.1a]
void draw_overlay(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const StoredPhotons& photons);

/// Declares "splat.explain.photons" and "splat.explain.sum": the photons whose kernels cover the picked
/// pixel, gathered from the whole photon buffer, and their sum against what was splatted.
void explain_pixel(graph::GraphBuilder& builder, const Kernels& kernels, graph::ImageRef irradiance);

}  // namespace ir::methods::photon_mapping
