#pragma once

#include "renderers/gl/program.h"
#include "renderers/graph/builder.h"
#include "renderers/methods/hbao/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::methods::hbao {

/// What is marched, before the blur.
struct Marched {
    graph::ImageRef sums;  ///< "hbao.sums" rgba32f: open, all (weights), directions cut off, samples taken
    graph::ImageRef raw;   ///< "hbao.raw" r32f
    graph::ImageRef cut;   ///< "hbao.cut" r32f: part of the directions
};

std::vector<OutputDescription> marched_outputs();

/// Declares the passes "march" and "resolve".
Marched march(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters);

/// Sets the uniforms of shaders/methods/hbao/march.glsl.
void set_march(const graph::PassContext& context, const gl::Program& program);

}  // namespace ir::methods::hbao
