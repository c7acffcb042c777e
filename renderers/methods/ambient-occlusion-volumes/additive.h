#pragma once

#include "renderers/core/output.h"
#include "renderers/methods/ambient-occlusion-volumes/volumes.h"

namespace ir::methods::ambient_occlusion_volumes {

/// Declares the passes "additive" and "compensate": "volumes.sum", the form factors of all triangles with
/// their fall-off, and "volumes.raw", the accessibility that is made of it, which is returned. [McGuire10]
graph::ImageRef add_up(graph::GraphBuilder& builder, const Volumes& volumes);

/// Declares the pass "count volumes".
void count_volumes(graph::GraphBuilder& builder, const Volumes& volumes);

std::vector<OutputDescription> additive_outputs();
std::vector<OutputDescription> count_outputs();

}  // namespace ir::methods::ambient_occlusion_volumes
