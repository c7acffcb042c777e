#pragma once

#include <string>
#include <vector>

#include "renderers/scene/world.h"

namespace ir::passes {

/// Light that emits no photons, where these come from the views of lights.
struct OtherLights {
    int areas = 0, emissive_triangles = 0;
    bool has_environment = false;
    int beyond = 0;  ///< point, spot and directional lights for which there was no room

    /// All but `beyond`.
    void count(const scene::Scene& scene, const scene::World& world);
    /// What a person should know about light that is missing; `room`: "64 lights".
    std::vector<std::string> notes(bool has_photons, const std::string& room) const;
};

}  // namespace ir::passes
