#pragma once

#include "renderers/core/transport.h"
#include "renderers/passes/bounce/batches.h"
#include "renderers/passes/gbuffer/gbuffer.h"

/// The bounced z-buffer: every sample of a pixel asks for the first surface along one direction of its own,
/// and whatever is splatted onto the pixel competes there by distance. [Nalbach15 §3]
namespace ir::passes::bounce {

/// How directions of ambient occlusion are spread over the hemisphere; light is always sampled by BRDF times
/// cosine.
enum class Distribution { uniform, cosine };

/// stratified: the samples of a pixel, and with them those of its neighbours or of its frames, are spread
/// evenly; independent: each for itself.
enum class Spread { stratified, independent };

inline constexpr int max_samples = 16;

/// What every method with a bounced z-buffer lets people choose of its directions.
struct DirectionParameters {
    int samples = 4;  ///< per pixel, 1 … max_samples
    Spread spread = Spread::stratified;
    Distribution distribution = Distribution::cosine;
    float min_roughness = 0.05f;  ///< smoother receivers are taken for this rough
};

/// What a method computes: without light it has no parameters that only light needs.
enum class Effects { ambient_occlusion, light };

/// `active_when` holds for `samples` and `spread`; the others are active where `paths` makes them count.
ParameterTable<DirectionParameters> direction_parameters(const Condition& active_when, Effects effects);

struct DirectionOptions {
    DirectionParameters parameters = {};
    bool light = false;  ///< by BRDF times cosine in place of `distribution`
    Transport::Materials materials = Transport::Materials::gltf;
    bool vary = false;  ///< other directions in each frame, for what averages over frames
};

/// The direction buffer. [Nalbach15 §3.1]
struct Directions {
    /// "bounce.directions" rgba32f stack, a layer per sample: xyz unit ω_p, world space; w its density α_p,
    /// 1/sr. All 0: nothing comes from there: background, unlit receivers of light, and directions of light
    /// that left the surface on no side. Those of ambient occlusion may point below the triangle's plane,
    /// where all is closed, as in the reference.
    graph::ImageRef directions;
    int samples = 0;  ///< layers: those of a batch
    DirectionOptions options;
};

Directions declare_directions(graph::GraphBuilder& builder, Batches& batches,
                              const DirectionOptions& options);
/// Declares the pass "directions" of a batch. The same seed gives the same directions.
void choose_directions(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                       const Directions& directions, const Batch& batch);
/// Both, for all samples at once.
Directions directions(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                      const DirectionOptions& options);

std::vector<OutputDescription> direction_outputs(const Condition& active_when);

}  // namespace ir::passes::bounce
