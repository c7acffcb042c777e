#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/record.h"
#include "shaders/methods/photon-mapping/records.glsl.h"

namespace ir::methods::photon_mapping {

/// RGB9E5: shared 5-bit exponent, three 9-bit mantissas, rounded to nearest; negative and NaN give 0, larger
/// than 65408 that.  [OpenGL 4.5 §8.25, EXT_texture_shared_exponent]
std::uint32_t packed_power(glm::vec3 power);
glm::vec3 unpacked_power(std::uint32_t bits);

/// The two words and the sign bit of a photon's directions.
struct StereographicDirection {
    std::uint32_t xy;
    bool below;  ///< z < 0
};
StereographicDirection packed_stereographic(glm::vec3 unit);
glm::vec3 unpacked_stereographic(std::uint32_t xy, bool below);

}  // namespace ir::methods::photon_mapping
