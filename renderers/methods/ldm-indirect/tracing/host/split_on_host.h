#pragma once

#include "renderers/methods/ldm-indirect/tracing/emission.h"

namespace ir::methods::ldm_indirect {

/// In place of building maps and of Splitter: declares the pass "trace photons through maps". Threads build
/// one map after the other, or a band of it, trace all primary photons through it and forget it. The same
/// photons in the same order, whatever the number of threads, as if all maps were one batch. `direct_fates`:
/// where primary photons were stored themselves, before these.
/// Sets photons.stored.
void split_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                   const passes::ldm::MapsPointer& maps, const Primaries& primaries, Photons& photons,
                   std::optional<graph::BufferRef> direct_fates, const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
