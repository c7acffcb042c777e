#pragma once

#include "renderers/passes/rsm/rsm.h"

namespace ir::passes {

/// Declares the pass "RSM" on the host's threads, which finds by rays what drawing shows: the same but at
/// edges. There is no depth that could be drawn first.
void rsm_on_host(graph::GraphBuilder& builder, const Rsm& rsm, const RsmOptions& options);

}  // namespace ir::passes
