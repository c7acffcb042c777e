#pragma once

#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/passes/rsm/rsm.h"

namespace ir::methods::ldm_indirect {

/// Lights that a photon's record can name.
inline constexpr int max_lights = 256;
/// Layers that every device has in an image.
inline constexpr int max_layers = 1024;

/// The views of the lights that emit photons, and what is left out.
struct LightViews {
    std::vector<passes::ShadowViewData> views;
    int areas = 0, emissive_triangles = 0, beyond = 0;  ///< lights that emit none
    bool has_environment = false;

    /// What a person should know about light that is missing.
    std::vector<std::string> notes() const;
};

/// Whole lights, in their order, as long as records and layers name them.
LightViews views_of_lights(const scene::Scene& scene, const scene::World& world, int resolution);

/// What each point, spot and directional light sees, `emission`² pixels per image; notes what emits nothing.
passes::Rsm draw_light_images(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const Parameters& parameters);

}  // namespace ir::methods::ldm_indirect
