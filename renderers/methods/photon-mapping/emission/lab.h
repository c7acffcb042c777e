#pragma once

#include "renderers/methods/photon-mapping/emission/points.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::photon_mapping {

/// Declares "emission.quadrants", "emission.levels" and "emission.explain.texel": the pyramid as a picture,
/// how well points follow each of its levels, and the way to the texel that the picked pixel's surface is in.
void show_levels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Sources& sources,
                 const MappedEmission& mapped, const EmissionPoints& points, const Parameters& parameters);

std::vector<OutputDescription> level_outputs();

}  // namespace ir::methods::photon_mapping
