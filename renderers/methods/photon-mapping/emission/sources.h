#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderers/core/condition.h"
#include "renderers/core/record.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/photons/other_lights.h"
#include "renderers/passes/shadow/shadow_maps.h"
#include "renderers/scene/world.h"
#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {

/// Of outputs that exist where the RSM finds first hits.
inline Condition from_rsm() {
    return {"first_hit", {std::string("rsm")}};
}

/// Layers that a sample point's record can name (6 bits).
inline constexpr int max_sources = 64;

/// The lights that emit photons, and why others do not.
struct Sources : passes::OtherLights {
    std::vector<SourceData> elements;           ///< at most max_sources
    std::vector<passes::ShadowViewData> views;  ///< of the RSM's layers, as many; empty where traced
    float flux = 0;                             ///< W, of all together

    std::vector<std::string> notes() const;
};

/// One source per layer of an RSM with this resolution.
Sources layers_of_lights(const scene::Scene& scene, const scene::World& world, int resolution);
/// One source per light, for rays from the lights.
Sources traced_lights(const scene::Scene& scene, const scene::World& world);

}  // namespace ir::methods::photon_mapping
