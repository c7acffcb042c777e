#pragma once

#include "renderers/graph/builder.h"
#include "renderers/methods/photon-mapping/parameters.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::methods::photon_mapping {

/// Where the photons of a frame start their first bounce.
struct SamplePoints {
    graph::BufferRef points;   ///< "photons.samples": SamplePoint, growable, in the order of their seeds
    graph::CounterRef count;   ///< of points; may exceed the buffer's capacity while it grows
    graph::BufferRef sources;  ///< "photons.sources": one element per layer of the RSM, see records.glsl
    float power_unit = 1;      ///< W: mean power that a photon is emitted with
    int photons_per_point = 1;
    std::uint64_t paths = 0;  ///< most photons that can leave: photons_per_point * points emitted
};

/// Declares the RSMs, the probability maps, the Haar pyramids, the warping and the sample points, with the
/// outputs below. With FirstHit::traced rays from the lights find the points instead.
SamplePoints emit(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                  const Parameters& parameters);

std::vector<OutputDescription> emission_outputs();
std::vector<SelectorDescription> emission_selectors();

}  // namespace ir::methods::photon_mapping
