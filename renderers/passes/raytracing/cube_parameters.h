#pragma once

#include "renderers/core/parameter.h"
#include "renderers/passes/raytracing/layered_depth_cube.h"

namespace ir::passes {

/// What methods let people choose of a layered depth cube, where their parameter "tracer" is "cube".
/// `since_version`: the method's version that introduced it.
ParameterTable<CubeOptions> cube_parameters(int since_version);

}  // namespace ir::passes
