#pragma once

#include <array>
#include <cstdint>

#include "renderers/core/fields.h"
#include "renderers/methods/ldm-indirect/tracing/emission.h"

namespace ir::methods::ldm_indirect {

/// Declares the passes "photons of bounce 2" and so on (cpu, whatever the processor), each of which fills the
/// records behind those of the bounce before: a photon goes on along one ray for each pair of these. The
/// number of photons halves with each bounce, so all bounces together cost less than twice the first.
/// [Aalund15 §6]
void go_on(graph::GraphBuilder& builder, const Primaries& primaries, graph::ObjectRef surfaces,
           const passes::ldm::Maps& maps, const Parameters& parameters);

/// A row of "indirect.bounces".
struct BounceRow {
    std::uint32_t bounce, photons;
    std::array<float, 3> sent, arrived, reflected, stored;
    IR_FIELDS(bounce, photons, sent, arrived, reflected, stored)
};

/// Declares "indirect.bounces": the flux of each bounce.
void sum_bounces(graph::GraphBuilder& builder, const Primaries& primaries);

std::vector<OutputDescription> bounce_outputs();

}  // namespace ir::methods::ldm_indirect
