#pragma once

#include "renderers/methods/ldm-indirect/tracing/emission.h"

namespace ir::methods::ldm_indirect {

/// How many there are in this frame.
ExtendedPhotons extended_photons(const graph::FrameInputs& inputs, const Parameters& parameters);

/// Declares the pass "emit photons of extended sources" (cpu, whatever the processor), which fills the
/// records behind those of the lights' images: photons start on the sources, and rays find the first surface.
/// [Aalund15 §6]
void emit_from_extended(graph::GraphBuilder& builder, const Primaries& primaries, graph::ObjectRef surfaces,
                        const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
