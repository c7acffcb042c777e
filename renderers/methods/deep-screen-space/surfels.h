#pragma once

#include "renderers/graph/builder.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/shadow/shadow_maps.h"
#include "shaders/methods/deep-screen-space/records.glsl.h"

namespace ir::methods::deep_screen_space {

/// The surfels of a frame.
struct Surfels {
    graph::BufferRef records;  ///< "surfels.records": Surfel, growable; the same order in every run
    graph::CounterRef count;   ///< of records; may exceed the buffer's capacity while it grows
};

/// Declares the passes that make surfels of the scene's triangles: cull and pre-tessellate, place fine
/// surfels by hardware tessellation and transform feedback, thin, shade. `reach` (m): surfels farther than
/// this from all that the camera may see can be culled. [Nalbach15 §4.1, §4.3]
Surfels make_surfels(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                     const passes::ShadowMaps& shadow, float reach, const Parameters& parameters);

/// Among them surfels before and after thinning, and the table of counts.
std::vector<OutputDescription> surfel_outputs();

}  // namespace ir::methods::deep_screen_space
