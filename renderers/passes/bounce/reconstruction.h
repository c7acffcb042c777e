#pragma once

#include "renderers/passes/blur/blur.h"
#include "renderers/passes/bounce/samples.h"

namespace ir::passes::bounce {

/// published: Σ w f L cos/α over Σ w [Nalbach15 §3.3]; its accessibility may exceed 1. ratio: Σ w V cos/α
/// over Σ w cos/α, ambient occlusion only.
enum class Estimator { ratio, published };

struct ReconstructionParameters {
    Estimator estimator = Estimator::ratio;
    BlurParameters blur{.radius = 3};
    float material_tolerance = 0.1f;  ///< difference of roughness or metalness at which weights are 1/e
    float balance = 0;                ///< part of the pixel's own samples beside each neighbour's
    float kernel_by_distance = 0;     ///< distances of hits that a kernel reaches at most; 0: no limit
};
/// `material_tolerance`, `balance` and, where there is a choice, `estimator` are active where `paths` makes
/// them count.
ParameterTable<ReconstructionParameters> reconstruction_parameters(const Condition& active_when,
                                                                   Effects effects);

/// What samples become: the image that `text` describes, of the view's size: accessibility (r32f, background
/// 1) or, where directions are of light, the radiance that the receiver reflects of what
/// its samples and its neighbours' met (rgba32f, W/(m² sr), background 0).
///
/// f_r and ⟨n, ω⟩ are taken once per sample with the receiving pixel's own surface, so that textures and
/// bumps survive; weights are those of passes::blur (the same code) times a Gaussian of materials'
/// differences. [Nalbach15 §3.3]
///
/// Samples are added up group by group, which carry their sums on in "bounce.sums", so that batches of
/// samples do not change a bit.
struct Reconstruction {
    SceneBuffers scene;
    GBuffer gbuffer;
    Directions directions;
    Samples samples;
    ReconstructionParameters parameters;
    int all_samples = 0;
    graph::ImageRef kernels = {};  ///< "bounce.kernels" r32f: radius of a pixel's kernel, pixels; only where
                                   ///< distances limit it
    graph::ImageRef sums = {};     ///< only of several groups: RGB of values or R of openness, A of shares
    graph::ImageRef result = {};
};
Reconstruction declare_reconstruction(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                      const GBuffer& gbuffer, const Directions& directions,
                                      const Samples& samples, const ReconstructionParameters& parameters,
                                      const Batches& batches, graph::ResourceText text);
/// Declares the passes "reconstruction" of a batch, one after the other in the batches' order.
void reconstruct(graph::GraphBuilder& builder, const Reconstruction& reconstruction, const Batch& batch);
/// Both, and all that explains, for all samples at once: the result.
graph::ImageRef reconstruct(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                            const Directions& directions, const Samples& samples,
                            const ReconstructionParameters& parameters, graph::ResourceText text,
                            float miss_length = 0);

/// What explains a reconstruction: what the picked pixel is made of, as lines from a pixel's point to what
/// its ray met, or as far as `miss_length` (m; 0: a tenth of the scene's diagonal): "bounce.explain.rays" its
/// own samples, "bounce.explain.neighbours" those of the other pixels that count for it. All contributions
/// together are the pixel.
struct RayExplanation {
    Reconstruction of;
    float miss_length = 0;
    graph::CountedBuffer own = {}, others = {};
    graph::BufferRef shares = {};  ///< "bounce.explain.shares": what contributions are divided by
};
RayExplanation declare_ray_explanation(graph::GraphBuilder& builder, const Reconstruction& reconstruction,
                                       float miss_length = 0);
/// Declares the pass "explain rays" of a batch, which was reconstructed.
void explain_rays(graph::GraphBuilder& builder, const RayExplanation& explanation, const Batch& batch);
/// Declares the pass "shares of rays", after all batches.
void share_rays(graph::GraphBuilder& builder, const RayExplanation& explanation);
/// Declares "bounce.weights", of all samples.
void show_weights(graph::GraphBuilder& builder, const Reconstruction& reconstruction);
/// "bounce.weights", and the lists of rays.
std::vector<OutputDescription> reconstruction_outputs(const Condition& active_when);

}  // namespace ir::passes::bounce
