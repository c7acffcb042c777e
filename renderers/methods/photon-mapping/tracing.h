#pragma once

#include "renderers/methods/photon-mapping/emission.h"

namespace ir::methods::photon_mapping {

/// The photon map of a frame.
struct Photons {
    graph::BufferRef records;  ///< "photons.records": Photon, growable, by bounce and then by path
    graph::CounterRef count;   ///< of records; may exceed the buffer's capacity while it grows
    float power_unit = 1;      ///< W
};

/// Traces 1 to max_bounces bounces and stores what arrives from min_bounces on. Bounce b is the b-th surface
/// after the sample point.
Photons trace_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                      const SamplePoints& samples, const Parameters& parameters);

std::vector<OutputDescription> tracing_outputs();

}  // namespace ir::methods::photon_mapping
