#pragma once

#include <optional>

#include "renderers/methods/ldm-indirect/stages.h"

namespace ir::methods::ldm_indirect {

/// What interfaces reflect of the scene.
struct GlossImages {
    graph::ImageRef radiance, error, distance;  ///< as gloss_outputs() lists them
};

/// At most so many smooth mirrors a path meets beside its bounces, as which they do not count.
inline constexpr int most_mirrors = 4;

/// A direction of a pixel that is drawn with density p stands for this over p sr of directions, highlights in
/// which are as wide: the more directions, the less.
float highlight_share(const graph::FrameInputs& inputs, const Parameters& parameters);

/// Declares the pass "gloss" and its outputs, 0 where no surface has an interface. Returns "gloss.radiance";
/// none without gloss. [Aalund15 §6]
std::optional<graph::ImageRef> reflect_gloss(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                             const passes::GBuffer& gbuffer, const Photons& photons,
                                             const Parameters& parameters);

/// The body for the host, of all tracers. Nodes of maps know no material, so surfaces, textures and lights of
/// the host say what is met.
void reflect_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const passes::ldm::MapsPointer& maps, const GlossImages& images,
                     const Parameters& parameters);
/// The body for the device, of exact rays: the same paths with the same random numbers.
void reflect_on_device(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::GBuffer& gbuffer, const GlossImages& images,
                       const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
