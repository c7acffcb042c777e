#pragma once

#include "renderers/methods/ambient-occlusion-volumes/bounced.h"

namespace ir::methods::ambient_occlusion_volumes {

/// Declares "volumes.explain.triangles", the triangles in whose volumes the picked pixel's point lies, in
/// their order, and the passes that fill it. Without visibility `directions` and `bounced` are null.
void explain(graph::GraphBuilder& builder, const Volumes& volumes,
             const passes::bounce::Directions* directions, const Bounced* bounced);

std::vector<OutputDescription> explanation_outputs();

}  // namespace ir::methods::ambient_occlusion_volumes
