#pragma once

#include "renderers/methods/ldm-ao/passes.h"

namespace ir::methods::ldm_ao {

/// First hits of exact rays in the directions of a batch of maps, to tell the causes of error apart.
struct ExactHits {
    graph::BufferRef hits;  ///< "ldm.exact_hits": see shaders/methods/ldm-ao/exact.glsl
    graph::ObjectRef bvh;
    Exact exact = Exact::none;
    float texels = 0;  ///< reach of `near`
};

/// Declares the buffer, large enough for every batch; not to be called for Exact::none.
ExactHits declare_exact_hits(graph::GraphBuilder& builder, const passes::ldm::Maps& maps,
                             const Parameters& parameters);

/// Pass "trace exact rays": fills the buffer for a batch.
void trace_exact(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                 const ExactHits& exact, const Transport& transport);

/// Constants of exact.glsl.
struct ExactConstants {
    unsigned exact_words = 0;
    float exact_texels = 0;
    IR_FIELDS(exact_words, exact_texels)
};
ExactConstants exact_constants(const ExactHits& exact, const passes::ldm::Maps& maps);

/// Distance up to which hits of the map come from exact rays, m; infinite for all of them.
float exact_reach(const passes::ldm::MapFrame& frame, Exact exact, float texels);

}  // namespace ir::methods::ldm_ao
