#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/fields.h"

namespace ir::methods::ldm_indirect {

/// A photon where it arrived, with its differential. 64 bytes; equals struct Photon of
/// shaders/methods/ldm-indirect/records.glsl. Seen as glyphs, photons are their footprints.
struct Photon {
    glm::vec3 centre_ws;
    std::uint32_t source;  ///< texel of the lights' images that it comes from: (layer * side + row) * side +
                           ///< column, side being the parameter `emission`
    glm::vec3 axis_u;      ///< m: half of D_u x, before scaling by splat_size and clamping
    std::uint32_t leg;  ///< bits 0-15 map, counted from 0; bit 16: 1 along its direction, 0 against it (or,
                        ///< bit 17: directly from the light); bits 24-31: light
    glm::vec3 axis_v;   ///< m: half of D_v x
    float path_length;  ///< m: from the light
    glm::vec3 flux;     ///< W
    std::uint32_t normal;  ///< geometric normal of the receiver, on the viewer's side; octahedral, 2 x 16
                           ///< bits SNORM
    IR_FIELDS(centre_ws, source, axis_u, leg, axis_v, path_length, flux, normal)
};

}  // namespace ir::methods::ldm_indirect
