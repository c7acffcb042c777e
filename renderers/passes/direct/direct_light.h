#pragma once

#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// Direct light of the scene's point, spot and directional lights with shadow maps.
struct DirectLight {
    graph::ImageRef radiance;     ///< "direct.radiance" rgba16f→rgba32f: reflected radiance towards the eye
    graph::ImageRef shadow_maps;  ///< "shadow.maps" depth32f stack: one layer per spot or directional light,
                                  ///< six per point light
};

struct DirectLightOptions {
    int shadow_resolution = 1024;
};

/// Declares the passes "shadow maps" and "direct light".
DirectLight direct_light(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                         const DirectLightOptions& options = {});

}  // namespace ir::passes
