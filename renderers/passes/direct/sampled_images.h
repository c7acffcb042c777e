#pragma once

#include "renderers/graph/resource.h"

namespace ir::passes {

/// A frame's samples are dealt to so many independent randomisations, whose differences tell the variance.
inline constexpr int max_groups = 4;
/// Surfaces that reflect less are filtered as if they did not: black ones show nothing of the light.
inline constexpr float min_reflectance = 0.02f;

/// What extended_light() makes of light samples, on either processor.
struct SampledResults {
    graph::ImageRef radiance, unfiltered, variance;  ///< as extended_light_outputs() lists them
};

struct SampledImages {
    graph::ImageRef sums;  ///< rgba32f, history: Σ of the groups' means; a: Σ of their squared luminance
    graph::BufferRef progress;  ///< history: how many groups, and which frame
    SampledResults results;
    graph::ImageRef even, reflectance;  ///< what is filtered, without materials
};

}  // namespace ir::passes
