#pragma once

#include "renderers/graph/builder.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/emission/sources.h"
#include "renderers/methods/photon-mapping/parameters.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::methods::photon_mapping {

/// Reflective shadow maps: what each light sees, one layer per shadow view. Empty texels are 0.
/// [Smal19 §5.1]
struct Rsm {
    graph::ImageRef albedo_roughness;  ///< "rsm.albedo_roughness" rgba8: linear base colour, roughness
    graph::ImageRef normal_metalness;  ///< "rsm.normal_metalness" rgba16f: shading normal on the light's
                                       ///< side; w: 1 + metalness, negative where nothing is scattered
    graph::ImageRef depth;             ///< "rsm.depth" depth32f: as "shadow.maps"
    graph::BufferRef views;            ///< "rsm.views": a ShadowViewData for each layer
    int resolution = 0, layers = 0;    ///< without lights one empty layer
    int views_drawn = 0;               ///< layers that have a view
    std::string fingerprint;           ///< of the contents
};

/// Declares the pass "RSM" (and "RSM depth"), which draw only when world, resolution or materials change.
Rsm draw_rsm(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Sources& sources,
             const Parameters& parameters);

/// Binds views to buffer 0, lights to buffer 1, albedo, normal and depth to textures 0 to 2: what
/// shaders/methods/photon-mapping/emission/rsm.glsl reads. Passes that do must read all five.
void reads_rsm(graph::PassBuilder& pass, const Rsm& rsm, const passes::SceneBuffers& scene);
void bind_rsm(const graph::PassContext& context, const Rsm& rsm, const passes::SceneBuffers& scene);

std::vector<OutputDescription> rsm_outputs();

}  // namespace ir::methods::photon_mapping
