#pragma once

#include "renderers/methods/photon-mapping/splatting/stored.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// Declares "photons.overlay": the photons over the picture.  [Smal19 fig. 8.1a]
void draw_overlay(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const StoredPhotons& photons);

}  // namespace ir::methods::photon_mapping
