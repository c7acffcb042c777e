#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "shaders/methods/ldm-indirect/records.glsl.h"

namespace ir::methods::ldm_indirect {

/// The photons of a frame that the camera sees.
struct Photons {
    graph::BufferRef records;  ///< "indirect.photons": Photon, growable, glyphs; in the order of batches of
                               ///< maps, then of sources, then of maps
    graph::CounterRef count;   ///< of records; may exceed the buffer's capacity while it grows
    passes::ldm::MapsPointer maps = {};  ///< of the directions along which they came
    /// Sources below this number are texels of the lights' images. Of the others it is not kept where their
    /// paths begin.
    std::uint64_t texels = std::numeric_limits<std::uint64_t>::max();
    /// How many there are to read, where the host stored some: passes on the device see no counter of its.
    std::optional<graph::BufferRef> stored = {};
    /// "indirect.looks", where footprints are clipped.
    std::optional<graph::BufferRef> looks = {};
    /// "indirect.primary_photons", which these come from.
    graph::BufferRef primaries = {};
    /// "splat.sums", where photons were splatted while they were traced.
    std::optional<graph::ImageRef> sums = {};
    std::optional<graph::BufferRef> arrivals = {};  ///< "splat.arrivals", which that needs before
    /// "ldm.sky", where the environment's direct light comes from the maps.
    std::optional<graph::ImageRef> sky = {};
};

/// Declares the lights' images, the maps, and the passes that emit, split, trace, reject and store photons,
/// with the outputs below. [Aalund15 §3.4, §4.2]
Photons trace_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                      const passes::GBuffer& gbuffer, const Parameters& parameters);

/// Of the field `side`: along which of the two directions of a map a photon came.
Categories side_categories();
/// Among them the maps' own, and the table of energy: what was emitted, stored, and lost by each cause.
std::vector<OutputDescription> tracing_outputs();
std::vector<SelectorDescription> tracing_selectors();

/// Irradiance of each pixel by density estimation. [Aalund15 eq. 4-7]
struct Splat {
    graph::ImageRef irradiance;  ///< "indirect.irradiance" rgba32f: RGB E, W/m²; A: photons that added to it
    graph::ImageRef
        direction;  ///< "indirect.direction" rgba32f: Σ (R + G + B) towards where light comes from
    graph::ImageRef of_frame;   ///< irradiance of this frame's photons alone, where others are in the mean
    graph::BufferRef stored;    ///< "splat.stored": photons that there are to be read
    graph::BufferRef arrivals;  ///< "splat.arrivals": where light comes from
};

/// By the way that the parameter `splatting` names. Photons that came directly from the light go to the same
/// image.
Splat splat_photons(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                    const Parameters& parameters);

/// "radiance", the main result: emission, direct light (by rasterisation with shadow maps, or by photons),
/// the splatted light, and `gloss` where there is some, as the transport's paths say. [Aalund15 §4.2, §5.2]
void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const Photons& photons, const Splat& splat, const Parameters& parameters,
             std::optional<graph::ImageRef> gloss = {});

/// The photons that light the picked pixel, by energy.
struct PixelPhotons {
    graph::BufferRef photons, sum;  ///< "indirect.explain.photons", "indirect.explain.sum"
};

/// What explains the picked pixel: its photons by energy, and their sum by a separate gather against what was
/// splatted; what each direction of the maps contributes to it; the paths of its photons.
PixelPhotons explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                     const Splat& splat, const Parameters& parameters);

/// By how much the irradiance of the picture, and of the picked pixel, changes where a direction is left out.
void show_effects(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                  const Splat& splat, const PixelPhotons& pixel, const Parameters& parameters);
std::vector<OutputDescription> effect_outputs();

/// How the brightest photon of the picked pixel was traced: the walk through its map, and an exact ray.
void explain_trace(graph::GraphBuilder& builder, const Photons& photons, const PixelPhotons& pixel);
std::vector<OutputDescription> trace_outputs();

std::vector<OutputDescription> splatting_outputs();

/// What grows with directions, photons and texels, and the published setting.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ldm_indirect
