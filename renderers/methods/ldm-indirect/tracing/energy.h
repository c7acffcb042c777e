#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "renderers/methods/ldm-indirect/tracing/emission.h"
#include "shaders/methods/ldm-indirect/tracing/energy.glsl.h"

namespace ir::methods::ldm_indirect {

/// Primary photons that are summed in one invocation, before one more adds up the sums: both loops stay below
/// the 65,535 turns after which software drivers leave a loop.
constexpr std::uint64_t photons_of_energy_block(std::uint64_t primary_photons) {
    constexpr std::uint64_t least = 64, max_blocks = 32768;
    return std::max(least, (primary_photons + max_blocks - 1) / max_blocks);
}

/// Declares the table and its counters. `splits`: whether photons are split at all; `direct_fates`: where
/// primary photons are stored themselves.
void sum_energy(graph::GraphBuilder& builder, const Primaries& primaries, bool splits,
                std::optional<graph::BufferRef> direct_fates);

std::vector<OutputDescription> energy_outputs();

}  // namespace ir::methods::ldm_indirect
