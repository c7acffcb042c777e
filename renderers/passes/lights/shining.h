#pragma once

#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/lights/emission_sampler.h"

namespace ir::passes {

/// All that the transport lets shine.
EmissionOptions shining_sources(const graph::FrameInputs& inputs, const Transport& transport);

/// Says in a note that nothing shines, where it is so, and what would.
void note_darkness(graph::GraphBuilder& builder, const Transport& transport);

}  // namespace ir::passes
