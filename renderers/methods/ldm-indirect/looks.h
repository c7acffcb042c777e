#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "renderers/graph/builder.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/builder.h"
#include "shaders/methods/ldm-indirect/looks.glsl.h"

namespace ir::methods::ldm_indirect {

/// As packed_look() of looks.glsl.
inline std::uint32_t packed_look(float units) {
    return std::min((std::bit_cast<std::uint32_t>(std::max(units, 1.0f)) >> look_shift) - shortest_look,
                    open_look);
}

/// Of looks.
inline float units_per_metre(const scene::World& world) {
    return 65536 / (2 * std::max(world.bounds.radius(), 1e-6f));
}

/// Where the looks of a tile by a map begin among the bytes: look_word() of looks.glsl.
inline std::size_t look_place(std::size_t tile, std::size_t maps, std::size_t map) {
    return (tile * maps + map) * (look_tile * look_tile);
}

/// "indirect.looks": how far pixels see towards where photons come from; none where nothing asks.
std::optional<graph::BufferRef> declare_looks(graph::GraphBuilder& builder, const Parameters& parameters);

/// Declares the pass "look from pixels" of a batch of maps, which was built.
void look_from_pixels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                      const passes::ldm::MapsPointer& maps, int batch, graph::BufferRef looks);

}  // namespace ir::methods::ldm_indirect
