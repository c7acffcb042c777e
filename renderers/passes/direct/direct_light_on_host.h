#pragma once

#include <optional>

#include "renderers/core/transport.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// The pass "direct light" for the host (cpu): as direct_light.frag, but with a ray in place of a shadow map,
/// so that shadows are sharp at any size. `extended` is added where it is given. `layer`: of depth peeling;
/// from 2 on light along the normals.
void direct_light_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                          Transport::Materials materials, std::optional<graph::ImageRef> extended,
                          graph::ImageRef radiance, int layer = 1);

}  // namespace ir::passes
