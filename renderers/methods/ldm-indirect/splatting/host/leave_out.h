#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "shaders/methods/ldm-indirect/splatting/contributions.comp.h"
#include "shaders/methods/ldm-indirect/tracing/primary.glsl.h"

namespace ir::methods::ldm_indirect {

/// What leaving out one of the 2N directions does.
struct DirectionEffect {
    std::array<float, 3> centre;
    std::array<float, 2> colatitude, longitude;
    std::uint32_t map;
    std::int32_t side;
    float effect, change;  ///< W/m²: root of the mean square, and mean
    IR_FIELDS(centre, colatitude, longitude, map, side, effect, change)
};

/// Of each direction over so many pixels, to which photons contribute. Where a direction is left out, its
/// photons are missing, and the others of each primary photon that would have sent one along it carry its
/// flux: by Σ|cosθ| / (Σ|cosθ| - |cosθ|) more. The same whatever the order of contributions and the threads.
std::vector<DirectionEffect> effects_of_leaving_out(std::vector<Contribution> contributions,
                                                    std::size_t pixels, std::span<const Primary> primaries,
                                                    const passes::ldm::Options& options, int threads);

}  // namespace ir::methods::ldm_indirect
