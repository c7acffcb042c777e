#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/tracing.h"

namespace ir::methods::ldm_indirect {

inline const std::string folder = "methods/ldm-indirect/splatting/";  ///< of its shaders

/// The photons that are there to be splatted.
struct StoredPhotons {
    graph::BufferRef records;
    graph::BufferRef stored;    ///< "splat.stored": how many, at most the capacity of records
    graph::BufferRef arrivals;  ///< "splat.arrivals": where light comes from
    Parameters parameters;
    graph::CounterRef count = {};  ///< of records; may exceed their capacity
};

/// Declares the passes "upload arrivals" and "measure footprints", which counts those that are mended.
StoredPhotons stored_photons(graph::GraphBuilder& builder, const Photons& photons,
                             const Parameters& parameters);

/// Passes over photons are divided into this many parts of the buffer, as how many there are is known on the
/// device only.
inline constexpr std::int64_t photon_parts = 1024;

struct PhotonRange {
    std::int64_t first, end;
};
PhotonRange photons_of(const graph::PassContext& context, const StoredPhotons& photons, graph::Slice slice);

/// Declares what splatting/footprint.glsl reads.
void reads_footprints(graph::PassBuilder& pass, const StoredPhotons& photons);

/// Buffers 0 to 2 and the uniforms of shaders/methods/ldm-indirect/splatting/footprint.glsl.
void set_footprints(const graph::PassContext& context, const gl::Program& program,
                    const StoredPhotons& photons);
/// Those of outline.glsl.
void set_outlines(const gl::Program& program, const scene::View& view);

}  // namespace ir::methods::ldm_indirect
