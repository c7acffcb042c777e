#pragma once

#include "renderers/graph/builder.h"
#include "renderers/methods/reference/parameters.h"

namespace ir::methods::reference {

/// Notes of what a person should know before trusting a picture of light: that nothing shines, that no path
/// counts, that some light cannot be found.
void note_limits(graph::GraphBuilder& builder, const Parameters& parameters);

}  // namespace ir::methods::reference
