#pragma once

#include <vector>

#include "renderers/core/method.h"
#include "renderers/graph/benchmark.h"
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

/// "hbao.explain.horizons" (values on the sphere), "hbao.explain.lines" and "hbao.explain.samples" of the
/// pixel that a person points at; empty while nobody does, and where the pixel shows no surface.
std::vector<OutputDescription> explanation_outputs();
SelectorDescription direction_selector();

/// Declares them and the pass "explain".
void explain(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters);

/// "hbao": the sensible setting and that of Aalund 2015's baseline; "hbao-radius": radii from 0.25 to 12.8 m.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::hbao
