#pragma once

#include "renderers/core/method.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"

namespace ir::methods::deep_screen_space {

/// Declares what explains splats with visibility: all that were splatted onto the picked pixel, found by a
/// search over all surfels, and what became of one surfel's splats on each level. Called by splat_visible.
void explain_splats(graph::GraphBuilder& builder, const VisibleSplats& visible);

std::vector<OutputDescription> explanation_outputs();  ///< only with visibility

/// "surfel": 0 is the one under the cursor, others are 1 + index, as winners are numbered.
SelectorDescription surfel_selector();

}  // namespace ir::methods::deep_screen_space
