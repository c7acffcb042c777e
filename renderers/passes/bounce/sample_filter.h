#pragma once

#include "renderers/passes/bounce/reconstruction.h"
#include "renderers/passes/bounce/reprojection.h"

namespace ir::passes::bounce {

/// How samples become pixels. blur: neighbours' samples with joint bilateral weights [Nalbach15 §3.3];
/// variance: each pixel's own, averaged over frames, then filtered as far as their variance says [Schied17].
enum class SampleFilter { blur, variance };

struct SampleFilterParameters {
    SampleFilter filter = SampleFilter::blur;
    float strength = 4;  ///< σ_l
};
ParameterTable<SampleFilterParameters> sample_filter_parameters(const Condition& active_when);

/// Of what pixels' own samples give, before they are filtered.
graph::ResourceText text_of_unfiltered(graph::ResourceText text);

/// A filter of samples in space and time.
struct VarianceFilter {
    Reconstruction of;  ///< without blur
    SampleFilterParameters parameters;
    graph::ImageRef moments;  ///< "bounce.moments" rgba32f: moments.comp
};
/// In place of `reconstruction`, whose result is then what the pixels' own samples give.
VarianceFilter declare_variance_filter(graph::GraphBuilder& builder, const Reconstruction& reconstruction,
                                       const SampleFilterParameters& parameters);
/// Declares the pass "moments of samples" of a batch, one after the other in the batches' order.
void add_moments(graph::GraphBuilder& builder, const VarianceFilter& filter, const Batch& batch);
/// Declares the passes that average over frames, where `reprojection` says so, and filter: the image that
/// `text` describes, as declare_reconstruction() has it.
graph::ImageRef filter_samples(graph::GraphBuilder& builder, const VarianceFilter& filter,
                               const ReprojectionParameters& reprojection, graph::ResourceText text);

}  // namespace ir::passes::bounce
