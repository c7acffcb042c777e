#pragma once

#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {

/// What the ways of splatting have in common: photons, the surfaces that they light, and the picture of sums.
struct SplatTask {
    StoredPhotons photons;
    graph::ImageRef position, normal;  ///< of the G-buffer; normal is the geometric one
    graph::ImageRef irradiance;        ///< rgba32f
};

void reads_task(graph::PassBuilder& pass, const SplatTask& task);

/// Points that a geometry shader makes rectangles of, added by blending in the order of the photons.
void splat_quads(graph::GraphBuilder& builder, const SplatTask& task);
/// Photons are sorted into bins of tiles, and pixels sum those of their bin in the order of the photons.
void splat_tiles(graph::GraphBuilder& builder, const SplatTask& task);
/// In place of splat_tiles: threads add photons to tiles of pixels in the caches of the host, in their order.
void splat_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const SplatTask& task);
/// A compute shader adds each photon to its pixels by atomic additions, in no order.
void splat_image_atomics(graph::GraphBuilder& builder, const SplatTask& task);

}  // namespace ir::methods::ldm_indirect
