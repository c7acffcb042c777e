#pragma once

#include "renderers/graph/frame_inputs.h"

namespace ir::passes {

/// What a picture that adds up over frames depends on.
enum class Watched {
    surfaces,            ///< visibility and shape
    surfaces_and_lights  ///< light that arrives, too
};

/// Whether this frame sees the same as the one before, so that what that one summed up still counts. Where
/// lights are watched, those on nodes of an animated scene count as moving: no frame tells where they were.
bool stands_still(const graph::FrameInputs& inputs, Watched watched);

}  // namespace ir::passes
