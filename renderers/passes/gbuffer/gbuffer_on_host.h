#pragma once

#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// Whether rays can find what the G-buffer shows: not where glass is to be left out, which is drawn.
bool has_host_body(const graph::FrameInputs& inputs, const GBufferOptions& options);

/// Declares the passes "G-buffer" (cpu), a ray through each pixel's centre, and "G-buffer, materials", which
/// is left out where nobody asks for what it fills; and what they read, which is kept while the world stays
/// the same. A software rasteriser draws every triangle; rays only find those that are seen. Textures are
/// filtered as there, by the levels that fit the pixel. With `nearer`, layer `layer` of depth peeling: what
/// lies behind the layer before.
void gbuffer_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, const GBufferOptions& options,
                     const GBuffer* nearer = nullptr, int layer = 1);

}  // namespace ir::passes
