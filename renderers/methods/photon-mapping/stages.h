#pragma once

#include <vector>

#include "renderers/core/method.h"
#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/photon-mapping/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::methods::photon_mapping {

/// Where the photons of a frame start their first bounce.
struct SamplePoints {
    graph::BufferRef points;   ///< "photons.samples": SamplePoint, growable, in the order of their seeds
    graph::CounterRef count;   ///< of points; may exceed the buffer's capacity while it grows
    graph::BufferRef sources;  ///< "photons.sources": layers of the RSM, then what rays were traced from
    float power_unit = 1;      ///< W: mean power that a photon is emitted with
    int photons_per_point = 1;
    std::uint64_t paths = 0;  ///< most photons that can leave: photons_per_point * points emitted
};

/// Declares the RSMs, the probability maps, the Haar pyramids, the warping and the sample points, with the
/// outputs below. Rays find the points of lights that have no RSM, with FirstHit::traced of all.
SamplePoints emit(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                  const Parameters& parameters);

std::vector<OutputDescription> emission_outputs();
std::vector<SelectorDescription> emission_selectors();

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

/// Irradiance by density estimation, before any filter, at the splatting resolution.
struct Splat {
    graph::ImageRef irradiance;  ///< "splat.irradiance" RGB: E, W/m²; A: x of the sum of directions to the
                                 ///< light, each weighted by R + G + B of what it adds
    graph::ImageRef direction;   ///< "splat.direction" RG: y and z of that sum, world space
    int divisor = 1;  ///< pixels of the view along a side of a texel, which is for one of them: 1, 2 or 4
};

Splat splat_photons(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                    const Parameters& parameters);

std::vector<OutputDescription> splatting_outputs();

/// Up-sampling, temporal filter, à-trous passes and clipped details: "filter.irradiance" and
/// "filter.direction" rg32f, at the view's resolution.
passes::ArrivedLight filter_irradiance(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                                       const Splat& splat, const Parameters& parameters);

/// The main result "radiance" and the final "irradiance": reflection of what was filtered, with direct light
/// and emission where the transport asks for them.
void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const passes::ArrivedLight& filtered, const Parameters& parameters);

std::vector<OutputDescription> filtering_outputs();
/// From the unfiltered estimate to the final irradiance.
std::vector<Stage> filtering_stages();

/// The pipeline at a size for software rendering, grown in one parameter after the other; and the published
/// settings. Time to an error that a path tracer has, too, is no benchmark of a method alone: plots of a
/// project measure it (`bench error --project`).
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::photon_mapping
