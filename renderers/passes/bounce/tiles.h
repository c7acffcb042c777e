#pragma once

#include "renderers/graph/pass_context.h"

namespace ir::passes::bounce {

/// Runs a pass over all pixels of the view in slices of 8 × 8 of them: a row of the picture would be too much
/// at once for the widest filters. `bind(context)` binds and returns a program whose shader includes
/// shaders/passes/bounce/tiles.glsl.
void execute_by_tiles(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                      std::function<const gl::Program&(graph::PassContext&)> bind);

}  // namespace ir::passes::bounce
