#pragma once

#include "renderers/graph/builder.h"
#include "renderers/methods/hbao/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

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

/// Constants of shaders/methods/hbao/march.glsl.
struct MarchConstants {
    passes::PixelRays rays;
    glm::mat4 pixel_from_world;
    IR_FIELDS(rays, pixel_from_world)
};
MarchConstants march_constants(const scene::View& view);

}  // namespace ir::methods::hbao
