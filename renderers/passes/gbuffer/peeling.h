#pragma once

#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// What lies behind the surfaces that are seen, along the same rays: layer 2 is the next surface behind those
/// of the G-buffer, layer 3 the one behind it. Keys end in the number: "gbuffer.position.2". Its normals
/// point to the triangle's front, by the winding: towards the viewer where a body is entered, away where it
/// is left. Glass is left out as in the G-buffer. `valid` and `glass` say nothing.
struct PeeledLayer {
    int number = 2;
    GBuffer surface = {};
};

/// Depth peeling: declares the pass "G-buffer, layer NUMBER", drawn or on the host, of what lies behind
/// `nearer`, the layer before. Surfaces that lie in one another are one.  [Everitt01]
PeeledLayer peel(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& nearer, int number,
                 const GBufferOptions& options);

/// Text of a layer's resource; 1: as it is.
graph::ResourceText of_layer(graph::ResourceText text, int number);
/// Name of a layer's pass likewise.
std::string pass_of_layer(const std::string& name, int number);

}  // namespace ir::passes
