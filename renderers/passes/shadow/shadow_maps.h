#pragma once

#include <vector>

#include "renderers/core/fields.h"
#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "renderers/scene/world.h"
#include "shaders/passes/shadow/shadow.glsl.h"

namespace ir::passes {

/// Where views lie that differ from frame to frame.
struct ViewJitter {
    glm::vec2 shift{0};  ///< texels, at most half of one each way: of spots and directional lights
    glm::mat3 turn{1};   ///< of the faces of point lights
};

/// The views of all lights in order of layer. Perspective for spots (the outer cone) and the six faces of
/// point lights (+x, -x, +y, -y, +z, -z); orthographic about the world's bounds for directional lights.
std::vector<ShadowViewData> shadow_views(const scene::World& world, int resolution,
                                         const ViewJitter& jitter = {});

/// What blocks the light of point, spot and directional lights; alpha masks are respected. Sheets of clear
/// glass let it pass (Panes), other glass blocks it.
struct ShadowMaps {
    graph::ImageRef maps;   ///< "shadow.maps" depth32f stack; see shaders/passes/shadow/shadow.glsl
    graph::ImageRef panes;  ///< "shadow.panes" rgba16f stack: fraction of the light that comes through sheets
                            ///< before what the map holds; one texel where there are none
    graph::BufferRef views;  ///< "shadow.views": a ShadowViewData for each layer

    /// Of programs with that file.
    void read_by(graph::PassBuilder& pass) const { pass.reads(views, maps, panes); }
};

/// Declares the pass "shadow maps". A light's layers begin at its `shadow_layer` in "scene.lights". The maps
/// stay while world and resolution (texels, square) stay; without lights there is one empty layer. Lambert's
/// materials know no glass.
ShadowMaps shadow_maps(graph::GraphBuilder& builder, const SceneBuffers& scene, int resolution,
                       Transport::Materials model);

}  // namespace ir::passes
