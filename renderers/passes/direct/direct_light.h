#pragma once

#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/shadow/shadow_maps.h"

namespace ir::passes {

/// Direct light of the scene's point, spot and directional lights with shadow maps.
struct DirectLight {
    graph::ImageRef radiance;  ///< "direct.radiance" rgba32f: reflected towards the eye, no emission;
                               ///< unlit materials show their base colour
    ShadowMaps shadow;         ///< one layer per directional light or spot, six per point light and per spot
                               ///< wider than 70 degrees about its axis
};

OutputDescription direct_output();  ///< "direct.radiance", for methods that list it among their outputs

struct DirectLightOptions {
    int shadow_resolution = 1024;  ///< texels along each side of a layer
    int shadow_filter_radius = 0;  ///< averages (2 r + 1)² texels; 0: hard edges
    Transport::Materials materials = Transport::Materials::gltf;
};

/// Declares the passes "shadow maps" and "direct light". Notes how many lights with extent are left out.
DirectLight direct_light(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                         const DirectLightOptions& options = {});

}  // namespace ir::passes
