#pragma once

#include "renderers/methods/reference/path_inputs.h"

namespace ir::methods::reference {

/// Declares the outputs "accessibility", "reference.variance" and "reference.samples", and the passes that
/// make them: "trace visibility", divisible into tiles and blocks of samples, and "average". Frames add up as
/// long as view and world stand still; a frame that moves starts anew.
void ambient_occlusion(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters);

}  // namespace ir::methods::reference
