#pragma once

#include <algorithm>

#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/scene/view.h"
#include "renderers/scene/world.h"

namespace ir::methods::ldm_indirect {

/// m across the view that a pixel spans at 1 m, or everywhere in a parallel view.
inline float pixel_size(const scene::View& view) {
    return 2 / (view.clip_from_view[1][1] * static_cast<float>(view.height));
}

/// m: what longer semi-axes are cut to.
inline float longest_axis(const Parameters& parameters, const scene::World& world) {
    return parameters.max_axis * std::max(world.bounds.radius(), 1e-6f);
}

}  // namespace ir::methods::ldm_indirect
