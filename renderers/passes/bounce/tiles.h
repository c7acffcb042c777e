#pragma once

#include "renderers/graph/pass_context.h"

namespace ir::passes::bounce {

/// An invocation for each pixel of the view, in slices of 8 × 8 of them: a row of the picture would be too
/// much at once for the widest filters. The shader includes shaders/passes/bounce/tiles.glsl, whose constants
/// come from here.
void compute_by_tiles(graph::PassBuilder& pass, const graph::GraphBuilder& builder,
                      const gl::ProgramSource& source, graph::Constants constants = {});

}  // namespace ir::passes::bounce
