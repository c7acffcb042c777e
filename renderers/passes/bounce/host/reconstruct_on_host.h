#pragma once

#include "renderers/passes/bounce/filter.h"

namespace ir::passes::bounce {

/// Declares the pass "reconstruction" on the host's threads: what reconstruct.comp writes into `result`, but
/// for rounding.
void reconstruct_on_host(graph::GraphBuilder& builder, const Filter& filter, graph::ImageRef result);

}  // namespace ir::passes::bounce
