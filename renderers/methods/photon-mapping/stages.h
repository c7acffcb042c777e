#pragma once

#include <optional>
#include <vector>

#include "renderers/core/method.h"
#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/photon-mapping/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::methods::photon_mapping {

/// What each texel of the light images learns of its photons.  [Smal19 §5.4]
struct TexelWeights {
    graph::BufferRef sums;   ///< "emission.weights.sums": i32 for each texel of all layers, row by row: what
                             ///< its photons of this frame add to its count
    graph::ImageRef counts;  ///< "emission.weights.counts" r32f: m, the same as a picture
    graph::ImageRef velocity, position;  ///< "emission.weights.velocity", "….position" r32f: v and x; those
                                         ///< of the frame before weigh this frame's map
    int resolution = 0, layers = 0;
    graph::ImageRef surfaces;  ///< that the picture shows, world space
};

/// Where the photons of a frame start their first bounce.
struct SamplePoints {
    graph::BufferRef points;   ///< "photons.samples": SamplePoint, growable, in the order of their seeds
    graph::CounterRef count;   ///< of points; may exceed the buffer's capacity while it grows
    graph::BufferRef sources;  ///< "photons.sources": layers of the RSM, then what rays were traced from
    float power_unit = 1;      ///< W: mean power that a photon is emitted with
    int photons_per_point = 1;
    std::uint64_t paths = 0;  ///< most photons that can leave: photons_per_point * points emitted
    std::optional<TexelWeights> weights = {};  ///< filled in while photons are traced
    std::uint32_t all_points = 0;              ///< of the frame's emission sets
    std::uint32_t from_maps = 0;               ///< of these the first ones; behind them each has a ray
    std::optional<graph::BufferRef> traced_rays = {};  ///< those rays: "emission.rays"
};

/// Declares the RSMs, the probability maps, the Haar pyramids, the warping and the sample points, with the
/// outputs below. Rays find the points of lights that have no RSM, with FirstHit::traced of all.
SamplePoints emit(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                  const passes::GBuffer& gbuffer, const Parameters& parameters);

/// Declares the pass "photon weights", which makes the next frame's weights of what this frame's photons met,
/// where the parameters ask for it.
void learn_weights(graph::GraphBuilder& builder, const SamplePoints& samples, const Parameters& parameters);

std::vector<OutputDescription> emission_outputs();
std::vector<SelectorDescription> emission_selectors();

/// What the paths of photons met, for views alone.
struct PhotonLegs {
    graph::BufferRef vertices;  ///< "photons.vertices": PathVertex, surfaces + 1 for each path: where it
                                ///< left, then what each of its rays met
    int surfaces = 0;           ///< along a path at most
    std::uint64_t paths = 0;    ///< of all the first ones, as many as a buffer holds
};

/// The photon map of a frame.
struct Photons {
    graph::BufferRef records;  ///< "photons.records": Photon, growable, by bounce and then by path
    graph::CounterRef count;   ///< of records; may exceed the buffer's capacity while it grows
    float power_unit = 1;      ///< W
    PhotonLegs legs = {};
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
    graph::ImageRef direction;   ///< "splat.direction" RG: y and z of that sum, world space. With
                                 ///< Receiver::full both are what passes::ArrivedLight says
    int divisor = 1;  ///< pixels of the view along a side of a texel, which is for one of them: 1, 2 or 4
    graph::BufferRef found;  ///< "splat.explain.photons": FoundPhoton, of the picked texel, strongest first
    graph::BufferRef sum;    ///< "splat.explain.sum"
};

Splat splat_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                    const passes::GBuffer& gbuffer, const Photons& photons, const Parameters& parameters);

std::vector<OutputDescription> splatting_outputs();

/// Declares "photons.explain.paths" and "photons.explain.picture": the ways of the photons that light the
/// picked pixel, in space and over the picture.
void show_paths(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const SamplePoints& samples,
                const Photons& photons, const Splat& splat);

std::vector<OutputDescription> path_outputs();
std::vector<SelectorDescription> path_selectors();

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
