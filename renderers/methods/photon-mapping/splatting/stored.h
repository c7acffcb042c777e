#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/tracing.h"

namespace ir::methods::photon_mapping {

/// The photons that are there to be read.
struct StoredPhotons {
    graph::BufferRef records;
    graph::BufferRef stored;  ///< "splat.stored": how many, at most the capacity of records
    float power_unit = 1;
};

/// Declares the pass "count photons".
StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons);

/// Passes over photons are divided into this many parts of the buffer, as how many there are is known on the
/// device only.
inline constexpr std::int64_t photon_parts = 1024;

/// The photons of some parts.
struct PhotonRange {
    std::uint64_t first, end;
};
PhotonRange photons_of(const graph::PassContext& context, const StoredPhotons& photons, graph::Slice slice);

/// Runs a compute program in use for each photon of the slice, as gl::dispatch_items.
void dispatch_photons(const graph::PassContext& context, const gl::Program& program,
                      const StoredPhotons& photons, graph::Slice slice);

}  // namespace ir::methods::photon_mapping
