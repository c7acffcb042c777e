#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/record.h"

namespace ir::methods::photon_mapping {

/// A point from which photons leave: where light arrived first, after the roulette there. 32 bytes; equals
/// struct SamplePoint of shaders/methods/photon-mapping/records.glsl.
/// DEVIATION [Smal19 table 5.1]: the table has normal (6 bytes), seed and padding; the material and the
/// texel take their place, as the first scattering needs them.
struct SamplePoint {
    glm::vec3 position_ws;
    std::uint32_t power;    ///< RGB9E5, in power units: of each photon that leaves, roulette included
    std::uint32_t normal;   ///< shading normal, on the side of the light; octahedral, 2 x 16 bits SNORM
    std::uint32_t surface;  ///< RGBA8 UNORM: base colour and roughness, R in the low byte
    std::uint32_t
        origin;  ///< bits 0-9 texel x, 10-19 texel y, 20-25 layer of the RSM, 26-31 metalness in 63rds
    std::uint32_t seed;  ///< index in the emission set: what all random numbers of its paths come from
    IR_FIELDS(position_ws, power, normal, surface, origin, seed)
};

/// A photon where it arrived. 32 bytes; equals struct Photon of records.glsl.  [Smal19 table 4.1]
struct Photon {
    glm::vec3 position_ws;
    std::uint32_t power;      ///< RGB9E5, in power units
    std::uint32_t normal;     ///< geometric normal on the side that was hit; stereographic, 2 x half
    std::uint32_t direction;  ///< from the surface to where the photon came from; stereographic, 2 x half
    float ray_length;         ///< m
    std::uint32_t bits;       ///< 0: normal is below z = 0; 1: direction is; 2-5 bounce, from 1; 6-11 light;
                              ///< 12-31 the low bits of the path's seed
    IR_FIELDS(position_ws, power, normal, direction, ray_length, bits)
};

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
