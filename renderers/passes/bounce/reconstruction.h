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
};
/// `material_tolerance`, `balance` and, where there is a choice, `estimator` are active where `paths` makes
/// them count.
ParameterTable<ReconstructionParameters> reconstruction_parameters(const Condition& active_when,
                                                                   Effects effects);

/// Declares the pass "reconstruction" and the image that `text` describes, of the view's size: accessibility
/// (r32f, background 1) or, where directions are of light, the radiance that the receiver reflects of what
/// its samples and its neighbours' met (rgba32f, W/(m² sr), background 0).
///
/// f_r and ⟨n, ω⟩ are taken once per sample with the receiving pixel's own surface, so that textures and
/// bumps survive; weights are those of passes::blur (the same code) times a Gaussian of materials'
/// differences. [Nalbach15 §3.3]
graph::ImageRef reconstruct(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                            const Directions& directions, const Samples& samples,
                            const ReconstructionParameters& parameters, graph::ResourceText text);

/// What the picked pixel is made of, as lines from a pixel's point to what its ray met, or as far as
/// `miss_length` (m; 0: a tenth of the scene's diagonal): "bounce.explain.rays" its own samples,
/// "bounce.explain.neighbours" those of the other pixels that count for it. All contributions together are
/// the pixel.
void explain_rays(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                  const Directions& directions, const Samples& samples,
                  const ReconstructionParameters& parameters, float miss_length = 0);

/// "bounce.weights", which `reconstruct` declares, and the two of `explain_rays`.
std::vector<OutputDescription> reconstruction_outputs(const Condition& active_when);

}  // namespace ir::passes::bounce
