#pragma once

#include <optional>
#include <string>

#include "renderers/passes/gbuffer/gbuffer.h"
#include "shaders/lib/material.glsl.h"

namespace ir::passes {

/// Whether a triangle may be mostly glass.
bool has_glass(const graph::FrameInputs& inputs);

/// What a G-buffer that leaves glass out says of it: declares "gbuffer.glass" and the pass "glass", which
/// also makes its pixels invalid. Nothing where no triangle may be glass.
std::optional<graph::ImageRef> glass_before(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                            const GBuffer& gbuffer, bool normal_maps);

/// Declares the pass "through glass", which multiplies `radiance` (rgba32f), the light from what the G-buffer
/// shows, by what glass before it lets through; and notes what is left out. Nothing where there is no glass.
void see_through_glass(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ImageRef radiance);

/// Notes, where there is glass, that it stops what `carriers`, such as surfels, bring.
void note_opaque_glass(graph::GraphBuilder& builder, const GBuffer& gbuffer, const std::string& carriers);

}  // namespace ir::passes
