#pragma once

#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/ldm/host/host_scene.h"
#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/ldm/parameters.h"

namespace ir::passes::ldm {

/// Whether maps with these options have a body on the host: it gives the picture of arrays that the compute
/// builder makes, and stands for no other, whose costs are what is looked at.
inline bool has_host_body(const Options& options) {
    return options.storage == StorageKind::arrays && options.builder == BuilderKind::compute;
}

/// What the parameters say of self-hits, for maps with such nodes.
SelfHitRule self_hit_rule(const MapParameters& parameters, NodeKind nodes = NodeKind::plain);

/// Declares the pass "build and trace maps" (cpu), which streams all maps through the caches of its threads:
/// each builds a few, queries them for all pixels and forgets them. Memory does not depend on their number.
/// `sums` (rg32f): Σ V cosθ and Σ cosθ. The same picture whatever the number of threads. Of `maps` only the
/// frames are used. While the maps stand still from frame to frame (`stands_still`), those that hold
/// outermost depths alone are kept as far as there is room, and only queried anew: the same picture, bit by
/// bit. [Aalund15 eq. 2]
void trace_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                   const std::shared_ptr<const Maps>& maps, const SelfHitRule& rule,
                   const Visibility& visibility, bool stands_still, graph::ImageRef sums);

/// Declares the pass "build and trace maps for self-hits": `counts` (rgba32f) as trace.comp has them with
/// LDM_VIEWS.
void count_self_hits_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ObjectRef meshlets,
                             const std::shared_ptr<const Maps>& maps, const SelfHitRule& rule,
                             graph::ImageRef counts);

}  // namespace ir::passes::ldm
