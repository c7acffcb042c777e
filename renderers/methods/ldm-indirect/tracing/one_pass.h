#pragma once

#include "renderers/methods/ldm-indirect/tracing/emission.h"

namespace ir::methods::ldm_indirect {

/// Why photons have to be stored; empty: they may be splatted while they are traced.
std::string needs_storing(const Parameters& parameters);

/// Declares what splatting in the pass that traces needs before: sets photons.sums and photons.arrivals.
void begin_one_pass(graph::GraphBuilder& builder, Photons& photons, const Parameters& parameters);

/// Declares the pass "trace and splat photons" of a batch of maps, which was built, and from which pixels
/// have looked. [Aalund15 §5.2]
void trace_and_splat(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const passes::ldm::MapsPointer& maps, int batch, const Primaries& primaries,
                     const Photons& photons, const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
