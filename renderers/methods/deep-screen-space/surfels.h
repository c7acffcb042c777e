#pragma once

#include <span>

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
    graph::BufferRef stored;   ///< "surfels.stored": how many there are to read, and how many there would be
    graph::BufferRef lights;   ///< "surfels.lights": SurfelLight of each; none without light
    std::string fingerprint;   ///< of all but `lights`

    bool are_lit() const { return lights.index >= 0; }
};

/// Those that a pass of the cpu queue may read; it reads `records` and `stored`.
std::span<const Surfel> stored_surfels(const graph::PassContext& context, const Surfels& surfels);

/// Declares the passes that make surfels of the scene's triangles: cull and pre-tessellate, place fine
/// surfels by hardware tessellation and transform feedback, thin, shade. `reach` (m): surfels farther than
/// this from all that the camera may see can be culled. [Nalbach15 §4.1, §4.3]
Surfels make_surfels(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                     const passes::ShadowMaps& shadow, float reach, const Parameters& parameters);

/// Among them surfels before and after thinning, and the table of counts.
std::vector<OutputDescription> surfel_outputs();

}  // namespace ir::methods::deep_screen_space
