#pragma once

#include "renderers/methods/ldm-indirect/tracing.h"

namespace ir::methods::ldm_indirect {

/// Irradiance of each pixel by density estimation. [Aalund15 eq. 4-7]
struct Splat {
    graph::ImageRef irradiance;  ///< "indirect.irradiance" rgba32f: RGB E, W/m²; A: photons that added to it
    graph::BufferRef stored;     ///< "splat.stored": photons that there are to be read
    graph::BufferRef arrivals;   ///< "splat.arrivals": where light comes from
};

/// By the way that the parameter `splatting` names. Photons that came directly from the light go to the same
/// image.
Splat splat_photons(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                    const Parameters& parameters);

/// "radiance", the main result: emission, direct light (by rasterisation with shadow maps, or by photons) and
/// the splatted light, as the transport's paths say. [Aalund15 §4.2, §5.2]
void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const Splat& splat, const Parameters& parameters);

/// What explains the picked pixel: its photons by energy, and their sum by a separate gather against what was
/// splatted; what each direction of the maps contributes to it; the paths of its photons.
void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
             const Splat& splat, const Parameters& parameters);

std::vector<OutputDescription> splatting_outputs();

}  // namespace ir::methods::ldm_indirect
