#pragma once

#include "renderers/core/method.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ssdo/parameters.h"
#include "renderers/passes/bounce/receiver.h"

namespace ir::methods::ssdo {

/// What samples need of a frame.
struct Inputs {
    passes::SceneBuffers scene;
    passes::GBuffer gbuffer;
    graph::ImageRef environment;
    Parameters parameters;
    float reach;  ///< longest step, m
};

/// The radius, or without one the diagonal of the scene's bounds: no surface is farther from another.
float reach_of(const graph::GraphBuilder& builder, const Parameters& parameters);

struct Sky {
    graph::ImageRef raw;            ///< "ssdo.sky.raw" rgba32f
    graph::ImageRef accessibility;  ///< "ssdo.accessibility" r32f
    graph::ImageRef cut;            ///< "ssdo.cut" r32f
};

/// Declares the pass "directional occlusion".
Sky gather_sky(graph::GraphBuilder& builder, const Inputs& inputs);

/// Declares the pass "indirect light" and "ssdo.indirect.raw" rgba32f of what pixels send (`senders`).
graph::ImageRef gather_indirect(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders);

std::vector<OutputDescription> gathered_outputs();

/// For passes that include shaders/methods/ssdo/samples.glsl: `senders` has no index where none are read.
void declare_reads(graph::PassBuilder& pass, const Inputs& inputs, graph::ImageRef senders);
gl::ProgramSource with_samples(const std::string& shader, const Inputs& inputs);
/// Constants of samples.glsl.
struct SampleConstants {
    passes::bounce::ReceiverConstants receiver;
    passes::PixelRays rays;
    glm::mat4 pixel_from_world;
    float reach;
    unsigned seed;
    IR_FIELDS(receiver, rays, pixel_from_world, reach, seed)
};
SampleConstants sample_constants(const graph::FrameInputs& frame, const Inputs& inputs);

}  // namespace ir::methods::ssdo
