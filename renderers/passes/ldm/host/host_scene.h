#pragma once

#include <vector>

#include "renderers/graph/builder.h"
#include "renderers/passes/ldm/host/streamed_map.h"
#include "renderers/passes/ldm/storage.h"
#include "renderers/passes/raytracing/alpha_masks.h"

namespace ir::passes::ldm {

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
    double build_ms = 0, query_ms = 0;
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
/// Of the coarser world where `detail` is below 1. Who asks again in a frame gets the same.
graph::ObjectRef declare_meshlets(graph::GraphBuilder& builder, float detail);

}  // namespace ir::passes::ldm
