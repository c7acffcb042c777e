#pragma once

#include "renderers/graph/pass_context.h"

namespace ir::passes::bounce {

/// Runs a pass over all pixels of the view in slices of 8 × 8 of them: a row of the picture would be too much
/// at once for the widest filters. `use(context)` makes a program current whose shader includes
/// shaders/passes/bounce/tiles.glsl.
void execute_by_tiles(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                      std::function<const gl::Program&(graph::PassContext&)> use);

}  // namespace ir::passes::bounce
