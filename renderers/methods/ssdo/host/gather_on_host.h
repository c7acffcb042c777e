#pragma once

#include "renderers/methods/ssdo/passes.h"

namespace ir::methods::ssdo {

/// The passes "directional occlusion" and "indirect light" for the host (cpu): the same but for rounding.
void gather_sky_on_host(graph::GraphBuilder& builder, const Inputs& inputs, const Sky& sky);
void gather_indirect_on_host(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders,
                             graph::ImageRef raw);

}  // namespace ir::methods::ssdo
