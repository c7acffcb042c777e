#pragma once

#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/direct/extended_light.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/shadow/shadow_maps.h"

namespace ir::passes {

/// Direct light of all sources: point, spot and directional lights with shadow maps, those with an extent by
/// samples.
struct DirectLight {
    graph::ImageRef radiance;  ///< "direct.radiance" rgba32f: reflected towards the eye, no emission;
                               ///< unlit materials show their base colour
    ShadowMaps shadow;         ///< one layer per directional light or spot, six per point light and per spot
                               ///< wider than 70 degrees about its axis
};

OutputDescription direct_output();  ///< "direct.radiance"
/// It, the first, and what it is made of, for methods that list them among their outputs.
std::vector<OutputDescription> direct_outputs();

struct DirectLightOptions {
    int shadow_resolution = 1024;        ///< texels along each side of a layer
    int shadow_filter_radius = 0;        ///< averages (2 r + 1)² texels; 0: hard edges
    ExtendedLightOptions extended = {};  ///< and the materials of all light
};

/// Of a method's transport: mirrors show sources where these are seen at all.
ExtendedLightOptions extended_light_options(const LightParameters& parameters, const Transport& transport);

/// Declares the passes "shadow maps" and "direct light", and, where there are sources with an extent, those
/// of extended_light(). On the host rays take the maps' place, which are drawn only for those who read them.
/// Notes what is left out.
DirectLight direct_light(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                         const DirectLightOptions& options = {});

}  // namespace ir::passes
