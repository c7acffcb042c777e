#pragma once

#include "renderers/passes/direct/extended_light.h"
#include "renderers/passes/direct/sampled_images.h"

namespace ir::passes {

/// Declares the pass "light samples" on the device. It draws the same samples as LightEstimate does on the
/// host; nothing is read back. Rays go through "direct.rays" in parts: one sample of as many pixels as fit.
void sample_on_device(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                      const SampledImages& images, const ExtendedLightOptions& options);

}  // namespace ir::passes
