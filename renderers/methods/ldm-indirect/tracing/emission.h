#pragma once

#include <array>

#include "renderers/core/record.h"
#include "renderers/methods/ldm-indirect/tracing/light_images.h"
#include "renderers/passes/ldm/builder.h"
#include "shaders/methods/ldm-indirect/tracing/primary.glsl.h"

namespace ir::methods::ldm_indirect {

inline constexpr int causes = 8;  ///< of primary.glsl

/// The photons up to the first surface, one for each texel of the lights' images.
struct Primaries {
    graph::BufferRef records;  ///< "indirect.primary_photons"
    graph::BufferRef shares;   ///< "indirect.shares", of each; zero until photons are split
    std::uint64_t count = 0;
};

/// The pass "emit photons".
Primaries emit_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::Rsm& images, const passes::ldm::Maps& maps);

}  // namespace ir::methods::ldm_indirect
