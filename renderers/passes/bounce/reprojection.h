#pragma once

#include "renderers/core/parameter.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// Blending with the last frame's picture, followed along its motion. [Scherzer12]
struct ReprojectionParameters {
    bool reprojection = false;
    float history = 0.9f;  ///< part of a pixel that its history may make up
};
ParameterTable<ReprojectionParameters> reprojection_parameters();

/// Declares the pass "reprojection" and the image that `text` describes, of the format of `image`:
/// exponential average along `gbuffer.velocity`, restarted where the last frame showed another surface; at
/// first the plain mean of the frames there are. Without `reprojection` gives `image` under the new key.
graph::ImageRef reproject(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ImageRef image,
                          const ReprojectionParameters& parameters, graph::ResourceText text);

std::vector<OutputDescription> reprojection_outputs();

}  // namespace ir::passes
