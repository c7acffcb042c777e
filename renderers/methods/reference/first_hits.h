#pragma once

#include "renderers/graph/builder.h"

namespace ir::methods::reference {

/// Declares what the G-buffer would be called: "gbuffer.position", "gbuffer.normal" and "gbuffer.albedo" of
/// the surface that the ray through the pixel's centre meets first; and "valid", which it returns: 1
/// everywhere, as rays see glass and background, too.
graph::ImageRef first_hits(graph::GraphBuilder& builder, graph::ObjectRef bvh, graph::ObjectRef surfaces);

}  // namespace ir::methods::reference
