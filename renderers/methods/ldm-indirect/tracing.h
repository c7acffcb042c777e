#pragma once

#include <optional>

#include "renderers/graph/builder.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "shaders/methods/ldm-indirect/records.glsl.h"

namespace ir::methods::ldm_indirect {

/// The photons of a frame that the camera sees.
struct Photons {
    graph::BufferRef records;  ///< "indirect.photons": Photon, growable, glyphs; in the order of batches of
                               ///< maps, then of sources, then of maps
    graph::CounterRef count;   ///< of records; may exceed the buffer's capacity while it grows
    /// How many there are to read, where the host stored some: passes on the device see no counter of its.
    std::optional<graph::BufferRef> stored = {};
};

/// Declares the lights' images, the maps, and the passes that emit, split, trace, reject and store photons,
/// with the outputs below. [Aalund15 §3.4, §4.2]
Photons trace_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                      const passes::GBuffer& gbuffer, const Parameters& parameters);

/// Among them the maps' own, and the table of energy: what was emitted, stored, and lost by each cause.
std::vector<OutputDescription> tracing_outputs();
std::vector<SelectorDescription> tracing_selectors();

}  // namespace ir::methods::ldm_indirect
