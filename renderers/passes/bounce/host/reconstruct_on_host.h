#pragma once

#include "renderers/passes/bounce/filter.h"

namespace ir::passes::bounce {

/// Declares the pass `name` on the host's threads: what reconstruct.comp writes into the sums or the result,
/// but for rounding.
void reconstruct_on_host(graph::GraphBuilder& builder, const Filter& filter, const SampleGroup& group,
                         const std::string& name, const Reconstruction& reconstruction);

}  // namespace ir::passes::bounce
