#pragma once

#include <optional>

#include "renderers/methods/ldm-indirect/stages.h"

namespace ir::methods::ldm_indirect {

/// Declares the pass "gloss" (cpu, whatever the processor: nodes know no material, so surfaces, textures and
/// lights of the host say what is met) and its outputs. Returns "gloss.radiance"; none without gloss.
/// [Aalund15 §6]
std::optional<graph::ImageRef> reflect_gloss(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                             const Photons& photons, const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
