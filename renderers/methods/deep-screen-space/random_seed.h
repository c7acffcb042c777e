#pragma once

#include <cstdint>

#include "renderers/graph/frame_inputs.h"
#include "renderers/methods/deep-screen-space/parameters.h"

namespace ir::methods::deep_screen_space {

/// What random choices of a frame are made of: where surfels lie, which pixels form a sub-image, which
/// sub-image a surfel is splatted into. The run's seed in one word; frames that are averaged each have
/// another.
inline unsigned random_seed(const graph::FrameInputs& inputs, const Parameters& parameters) {
    const auto seed =
        static_cast<unsigned>(inputs.seed) + 0x85ebca6bu * static_cast<unsigned>(inputs.seed >> 32);
    const auto frame = parameters.reprojection.reprojection ? static_cast<unsigned>(inputs.frame) : 0u;
    return seed + frame * 0x9e3779b9u;
}

}  // namespace ir::methods::deep_screen_space
