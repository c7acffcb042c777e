#pragma once

#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/ldm/parameters.h"
#include "renderers/passes/raytracing/alpha_masks.h"

namespace ir::passes::ldm {

/// Whether maps with these options have a body on the host: it gives the picture of arrays that the compute
/// builder makes, and stands for no other, whose costs are what is looked at.
inline bool has_host_body(const Options& options) {
    return options.storage == StorageKind::arrays && options.builder == BuilderKind::compute;
}

/// What the parameters say of self-hits.
SelfHitRule self_hit_rule(const MapParameters& parameters);

/// The scene as the host's maps are built from it.
struct HostScene {
    Meshlets meshlets;
    AlphaMasks masks;
};

/// Threads of passes on the host.
int host_threads(const graph::FrameInputs& inputs);

/// What one thread did for maps on the host.
struct HostWork {
    std::uint64_t fragments = 0, bytes = 0;  ///< made, held
    double build_ms = 0, ask_ms = 0;
};

/// Of all maps that a pass builds on the host.
struct HostCounters {
    graph::CounterRef fragments, texels, bytes;
    /// Adds up what the threads did. Times are means over them.
    void report(const graph::PassContext& context, const Layout& layout,
                const std::vector<HostWork>& threads) const;
};
HostCounters declare_host_counters(graph::GraphBuilder& builder);

/// Declares the object "ldm.meshlets", a HostScene, and its pass (cpu), kept while the world stays the same.
/// Who asks again in a frame gets the same.
graph::ObjectRef declare_meshlets(graph::GraphBuilder& builder);

/// Declares the pass "build and trace maps" (cpu), which streams all maps through the caches of its threads:
/// each builds a few, asks them for all pixels and forgets them. Memory does not depend on their number.
/// `sums` (rg32f): Σ V cosθ and Σ cosθ. The same picture whatever the number of threads. Of `maps` only the
/// frames are used. While the maps stand still from frame to frame (`stands_still`), those that hold
/// outermost depths alone are kept as far as there is room, and only asked anew: the same picture, bit by
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
