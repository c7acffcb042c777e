#pragma once

#include <memory>

#include "renderers/graph/builder.h"
#include "renderers/methods/ldm-ao/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/builder.h"

namespace ir::methods::ldm_ao {

using passes::ldm::MapsPointer;

struct Images {
    graph::ImageRef sums;     ///< "ldm.sums" rg32f: Σ V cosθ, Σ cosθ
    graph::ImageRef average;  ///< "ldm.average" rg32f with history: mean and frames; only if progressive
    graph::ImageRef accessibility;              ///< r32f
    graph::ImageRef view_counts;                ///< "ldm.self_hit_counts" rgba32f
    graph::ImageRef self_hits, missing, leaks;  ///< r32f, parts of the directions
    graph::ImageRef self_hit_overlay;           ///< rgba16f, linear colours
};

/// The output "ldm.self_hit_overlay".
OutputDescription overlay_output();

Images declare_images(graph::GraphBuilder& builder, const Parameters& parameters);

struct ExactHits;

/// Pass "trace": adds the directions of a batch to the sums. `exact` (may be null) replaces hits of the maps.
void trace(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
           const Images& images, const ExactHits* exact);
/// Pass "trace self-hits": the same for the views of self-hits.
void trace_views(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, MapsPointer maps, int batch,
                 const Images& images);
/// Whether the host can do with these parameters what trace() and trace_views() do.
bool has_host_body(const Parameters& parameters);
/// On the host in their place, for all maps: passes "build and trace maps" and "build and trace maps for
/// self-hits".
void trace_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const MapsPointer& maps,
                   const Images& images, const Parameters& parameters);
/// Pass "accessibility".
void resolve(graph::GraphBuilder& builder, const Images& images, const Parameters& parameters);
/// Passes "self-hit views" and "self-hit overlay".
void resolve_views(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Images& images);

}  // namespace ir::methods::ldm_ao
