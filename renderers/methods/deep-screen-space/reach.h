#pragma once

#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/scene/world.h"

namespace ir::methods::deep_screen_space {

/// How far the shells reach. d · 2^(levels − 1) is the transport's maximum distance, where it has one.
struct Reach {
    float shell_radius;  ///< m: d
    float whole;         ///< m: d · 2^(levels − 1)
};
Reach reach_of(const Parameters& parameters, const scene::World& world);

}  // namespace ir::methods::deep_screen_space
