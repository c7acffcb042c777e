#pragma once

#include <vector>

#include "renderers/methods/reference/path_inputs.h"

namespace ir::methods::reference {

/// Declares the outputs "radiance", "direct", "indirect" (the two of full paths only), "reference.variance"
/// and "reference.samples", and the passes that make them: "trace paths", divisible into tiles and blocks of
/// samples, and "average". Frames add up as long as view and world stand still.
/// `specular`: specular_materials() of the scene.
void light_paths(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters,
                 const std::vector<bool>& specular);

}  // namespace ir::methods::reference
