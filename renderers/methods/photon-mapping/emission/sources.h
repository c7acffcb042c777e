#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderers/core/record.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/shadow/shadow_views.h"
#include "renderers/scene/world.h"

namespace ir::methods::photon_mapping {

/// Layers that a sample point's record can name (6 bits).
inline constexpr int max_sources = 64;

/// Where photons come from: a layer of the RSM, or a light whose rays are traced. Equals struct Source of
/// shaders/methods/photon-mapping/records.glsl.
struct SourceData {
    glm::vec3 origin_ws{0};
    float perspective = 0;          ///< 1, or 0 for a directional light
    glm::vec3 direction_ws{0};      ///< of travel
    std::uint32_t light = 0;        ///< index into World::lights
    glm::vec3 intensity{0};         ///< W/sr, or W/m² of a directional light
    float flux = 0;                 ///< W, of all channels' mean, before the surface
    std::uint32_t first_point = 0;  ///< of the emission set; found on the device
    std::uint32_t points = 0;       ///< found on the device
    std::array<std::uint32_t, 2> unused{};
    IR_FIELDS(origin_ws, perspective, direction_ws, light, intensity, flux, first_point, points, unused)
};

/// The lights that emit photons, and why others do not.
struct Sources {
    std::vector<SourceData> elements;                   ///< at most max_sources
    std::vector<passes::ShadowViewData> views;          ///< of the RSM's layers, as many; empty where traced
    float flux = 0;                                     ///< W, of all together
    int areas = 0, emissive_triangles = 0, beyond = 0;  ///< lights that are left out; see notes()
    bool has_environment = false;

    /// What a person should know about light that is missing.
    std::vector<std::string> notes() const;
};

/// One source per layer of an RSM with this resolution.
Sources layers_of_lights(const scene::Scene& scene, const scene::World& world, int resolution);
/// One source per light, for rays from the lights.
Sources traced_lights(const scene::Scene& scene, const scene::World& world);

}  // namespace ir::methods::photon_mapping
