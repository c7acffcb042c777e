#pragma once

#include <optional>

#include "renderers/passes/direct/extended_light.h"
#include "renderers/passes/gbuffer/peeling.h"

namespace ir::passes {

/// Declares "direct.radiance.NUMBER", rgba32f: direct light of all sources that the front of what a layer
/// shows reflects along its normal, W/(m² sr), without emission; unlit materials show their base colour. By
/// rays on the host with either processor.
graph::ImageRef peeled_direct_light(graph::GraphBuilder& builder, const PeeledLayer& layer,
                                    const ExtendedLightOptions& options);

/// Its part of sources with an extent, "direct.extended.unfiltered.NUMBER", never filtered. None where there
/// is no such source.
std::optional<graph::ImageRef> peeled_extended_light(graph::GraphBuilder& builder, const PeeledLayer& layer,
                                                     const ExtendedLightOptions& options);

}  // namespace ir::passes
