#pragma once

#include "renderers/methods/photon-mapping/emission/points.h"
#include "renderers/passes/raytracing/trace_rays.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::photon_mapping {

/// Points whose first hits are traced: those behind the ones of maps, a ray each.  [Smal19 §5, fig. 5.1]
struct TracedEmission {
    passes::RayBuffers rays;   ///< "emission.rays", "emission.hits"
    graph::BufferRef emitted;  ///< "emission.emitted": EmittedRay of each ray
    graph::BufferRef rows;     ///< "emission.traced_sources": Sources::traced_rows with their points
    passes::HitSurfaces surfaces;
};

/// The passes "emission rays", on the host, which starts the rays by power (passes::EmissionSampler), and
/// "trace emission".
TracedEmission trace_emission(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const Sources& sources, const EmissionPoints& points,
                              const Parameters& parameters);
/// The pass "traced emission points": the roulette where rays hit.
void survive_hits(graph::GraphBuilder& builder, const TracedEmission& traced, const Sources& sources,
                  const EmissionPoints& points, const Parameters& parameters);
/// The pass "traced sample points", which packs the survivors.
void pack_hits(graph::GraphBuilder& builder, const TracedEmission& traced, const Sources& sources,
               const EmissionPoints& points, const Parameters& parameters);

}  // namespace ir::methods::photon_mapping
