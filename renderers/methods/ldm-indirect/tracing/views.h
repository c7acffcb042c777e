#pragma once

#include "renderers/methods/ldm-indirect/tracing.h"
#include "renderers/methods/ldm-indirect/tracing/emission.h"

namespace ir::methods::ldm_indirect {

/// Declares "indirect.primary", the photons at the first surface, as glyphs.
void show_primaries(graph::GraphBuilder& builder, const Primaries& primaries);

/// Declares "indirect.footprints", the stored photons with their legs told apart. `reserved` elements at
/// first, `most` at all.
void show_photons(graph::GraphBuilder& builder, const Photons& photons, std::uint64_t reserved,
                  std::uint64_t most);

std::vector<OutputDescription> view_outputs();

}  // namespace ir::methods::ldm_indirect
