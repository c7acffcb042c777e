#pragma once

#include "renderers/graph/builder.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes {

/// What blocks the light of point, spot and directional lights; alpha masks are respected, glass blocks.
struct ShadowMaps {
    graph::ImageRef maps;    ///< "shadow.maps" depth32f stack; see shaders/passes/shadow/shadow.glsl
    graph::BufferRef views;  ///< "shadow.views": a ShadowViewData for each layer
};

/// Declares the pass "shadow maps". A light's layers begin at its `shadow_layer` in "scene.lights". The maps
/// stay while world and resolution (texels, square) stay; without lights there is one empty layer.
ShadowMaps shadow_maps(graph::GraphBuilder& builder, const SceneBuffers& scene, int resolution);

}  // namespace ir::passes
