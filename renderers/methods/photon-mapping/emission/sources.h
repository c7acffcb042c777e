#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderers/core/condition.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/photon-mapping/parameters.h"
#include "renderers/passes/lights/emission_sampler.h"
#include "renderers/passes/shadow/shadow_maps.h"
#include "shaders/methods/photon-mapping/emission/budget.comp.h"
#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {

/// Of outputs that exist where an RSM finds first hits.
inline Condition from_rsm() {
    return {"first_hit", {std::string("rsm")}};
}

/// How photons name, in six bits, the light that they come from: its number, or one of these.
inline constexpr std::uint32_t light_beyond = 61,  ///< a light that comes later
    light_mesh = 62,                               ///< an emissive surface
    light_sky = 63;                                ///< the environment
/// `emitter` as passes::EmittedLight has it.
std::uint32_t light_name(int emitter);

/// Everything that emits photons. Point, spot and directional lights have layers of an RSM as long as there
/// is room and the parameters ask for it; rays are traced from all others.
struct Sources {
    std::vector<SourceData> layers;             ///< at most max_layers
    std::vector<passes::ShadowViewData> views;  ///< of the layers
    passes::EmissionOptions traced;             ///< what rays start from
    std::vector<SourceData> traced_rows;        ///< one for each light of those, emissive meshes, environment
    float layer_flux = 0;                       ///< W, of all layers together
    float traced_flux = 0;   ///< W of what is traced, textures and maps estimated, as far as it counts: the
                             ///< environment at most three times what everything else has
    float largest_flux = 0;  ///< W of the environment where that is more, else of all

    float flux() const { return layer_flux + traced_flux; }
    bool has_traced() const { return !traced_rows.empty(); }
};

/// `resolution` of the RSM.
Sources find_sources(const graph::FrameInputs& inputs, const Parameters& parameters, int resolution);

}  // namespace ir::methods::photon_mapping
