#pragma once

#include <glm/glm.hpp>

#include "renderers/core/output.h"
#include "renderers/core/transport.h"
#include "renderers/passes/direct/direct_light.h"

namespace ir::passes {

/// What a method of light says of its output "radiance".
OutputDescription radiance_output(const Condition& active_when = {});

/// Declares the pass "compose" and "radiance", rgba32f in W/(m² sr): as `transport.paths` say the sum of
/// `indirect` (rgba32f, towards the eye), direct light, emission, and seen_light(). Paths of ambient
/// occlusion have no such picture: throws std::logic_error.
graph::ImageRef compose_light(graph::GraphBuilder& builder, const GBuffer& gbuffer, const DirectLight& direct,
                              graph::ImageRef indirect, const Transport& transport);

}  // namespace ir::passes
