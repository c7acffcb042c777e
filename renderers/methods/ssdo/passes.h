#pragma once

#include <optional>
#include <vector>

#include "renderers/core/method.h"
#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/ssdo/parameters.h"
#include "renderers/passes/bounce/receiver.h"
#include "renderers/passes/direct/direct_light.h"

namespace ir::methods::ssdo {

/// Extent of the map that directions look up, texels.
constexpr int environment_width = 64, environment_height = 32;

/// Declares the pass "environment" and "ssdo.environment", rgba32f: radiance of the scene's environment,
/// equirectangular, each texel the mean over its solid angle, so that few directions miss little of a small
/// sun. 0 where `lit` is false.
graph::ImageRef environment(graph::GraphBuilder& builder, bool lit);

/// Declares passes that blur `raw`, W/(m² sr), without its materials' reflectance, into the output `key`.
graph::ImageRef blurred(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ImageRef raw,
                        const std::string& key, const Parameters& parameters);

struct Lit {
    graph::ImageRef seen;     ///< "ssdo.direct" rgba32f
    graph::ImageRef senders;  ///< "ssdo.senders" rgba32f: without unlit surfaces
};

/// Declares the pass "add environment light". `sky`: environment light; null: there is none.
Lit add_sky(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const passes::DirectLight& direct,
            const graph::ImageRef* sky);

std::vector<OutputDescription> light_outputs();
/// Of what is there only where open directions let the environment in.
inline const Condition by_occlusion{"environment_by", {std::string("occlusion")}};

/// Layers of depth peeling behind what is seen, layer 2 first: stacks, rgba32f.
struct HiddenLayers {
    graph::ImageRef positions;  ///< "ssdo.hidden.positions"
    graph::ImageRef normals;    ///< "ssdo.hidden.normals": of the triangles' fronts
    graph::ImageRef senders;    ///< "ssdo.hidden.senders"
};
/// Declares them and the passes that make them; none with one layer. `light`: that of what is seen.
std::optional<HiddenLayers> hidden_layers(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                          const passes::GBuffer& gbuffer, const Parameters& parameters,
                                          const passes::ExtendedLightOptions& light);

/// What samples need of a frame.
struct Inputs {
    passes::SceneBuffers scene;
    passes::GBuffer gbuffer;
    std::optional<HiddenLayers> hidden;
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

/// What the pixels' surfaces are to samples.
passes::bounce::Receivers receivers_of(const Inputs& inputs);

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

/// "ssdo.explain.samples" and "ssdo.explain.lines" of the pixel that a person points at; empty while nobody
/// does, and where the pixel shows no surface.
std::vector<OutputDescription> explanation_outputs();
SelectorDescription sample_selector();

/// Declares them and the pass "explain".
void explain(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders);

/// "ssdo": numbers of samples, with and without the blur, and the published estimator.
std::vector<graph::Benchmark> benchmarks();

}  // namespace ir::methods::ssdo
