#include "renderers/methods/deep-screen-space/reach.h"

#include <algorithm>
#include <cmath>

namespace ir::methods::deep_screen_space {

Reach reach_of(const Parameters& parameters, const scene::World& world) {
    const float shells = std::ldexp(1.0f, parameters.levels - 1);
    if (parameters.transport.max_distance > 0)
        return {parameters.transport.max_distance / shells, parameters.transport.max_distance};
    const float automatic = std::max(2 * world.bounds.radius(), 1e-6f) / 64;
    const float d = parameters.shell_radius > 0 ? parameters.shell_radius : automatic;
    return {d, d * shells};
}

}  // namespace ir::methods::deep_screen_space
