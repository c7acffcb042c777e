#pragma once

#include <glm/glm.hpp>

#include "renderers/methods/ldm-indirect/host_math.h"
#include "shaders/methods/ldm-indirect/records.glsl.h"
#include "shaders/methods/ldm-indirect/tracing/primary.glsl.h"

namespace ir::methods::ldm_indirect {

inline glm::vec3 reflected_flux(const Primary& p) {
    return p.emitted * p.reached * p.reflectance;
}

/// A photon behind the first surface where it is stored.
struct Child {
    std::uint32_t map;
    float distance;        ///< m, from the first surface
    std::uint32_t normal;  ///< as Photon::normal
    std::uint32_t beyond;  ///< 64ths of its kernel that lie beyond its surface
};

/// The record of a child that flew along ±`map_direction`, as store.comp makes it. `half_turn`: half of the
/// angle that the region of its direction spans, 0 under the published footprint. [Aalund15 §3.4; Igehy99]
Photon photon_of(const Primary& primary, const Child& child, const glm::vec3& map_direction, float half_turn);

}  // namespace ir::methods::ldm_indirect
