#pragma once

#include "renderers/methods/ldm-ao/passes.h"
#include "renderers/passes/ldm/points.h"

namespace ir::methods::ldm_ao {

/// What explains the pixel that a person points at. Everything is empty while nobody does, and where the
/// pixel shows no surface.
struct Explanation {
    graph::BufferRef hits;     ///< "ldm.explain.hits": the pixel's accessibility, gathered by direction
    graph::BufferRef rays;     ///< "ldm.explain.rays": the same as lines
    graph::BufferRef entries;  ///< "ldm.explain.entries": the sequence at the texel that is asked
    graph::BufferRef walk;     ///< "ldm.explain.walk": what was found from there, and the way there
    graph::BufferRef texel;    ///< "ldm.explain.texel": its outline
    graph::CounterRef hit_count, ray_count, entry_count, walk_count, texel_count;
};

/// Their descriptions.
std::vector<OutputDescription> explanation_outputs();

Explanation declare_explanation(graph::GraphBuilder& builder, const passes::ldm::Maps& maps,
                                passes::ldm::MapRange chosen);

/// Passes "explain hits" of all maps of the batch and "explain entries" of those chosen.
void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
             graph::BufferRef directions, passes::ldm::MapRange chosen, const Explanation& explanation);

}  // namespace ir::methods::ldm_ao
