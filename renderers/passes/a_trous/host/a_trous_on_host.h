#pragma once

#include "renderers/passes/a_trous/a_trous.h"

namespace ir::passes::a_trous {

/// Of the pixel in the kernel's middle, and one and two steps away.

/// Declares a step's pass on the host's threads: what a_trous.comp writes, but for rounding.
void filter_on_host(graph::GraphBuilder& builder, const Step& step, const Options& options,
                    const std::string& name);

}  // namespace ir::passes::a_trous
