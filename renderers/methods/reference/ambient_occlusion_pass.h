#pragma once

#include "renderers/graph/builder.h"
#include "renderers/methods/reference/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::reference {

/// Declares the outputs "accessibility", "reference.variance" and "reference.samples", and the passes that
/// make them: "trace visibility", divisible into tiles and portions of samples, and "average". Frames add up
/// as long as view and world stand still; a frame that moves starts anew.
void ambient_occlusion(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ObjectRef bvh,
                       const Parameters& parameters);

}  // namespace ir::methods::reference
