#pragma once

#include "renderers/methods/hbao/passes.h"

namespace ir::methods::hbao {

/// The pass "march" for the host (cpu): the same sums but for rounding.
void march_on_host(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters,
                   graph::ImageRef sums);

}  // namespace ir::methods::hbao
