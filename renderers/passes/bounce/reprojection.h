#pragma once

#include <functional>

#include "renderers/core/parameter.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir::passes {

/// Blending with the last frame's picture, followed along its motion. [Scherzer12]
struct ReprojectionParameters {
    bool reprojection = false;
    float history = 0.9f;  ///< part of a pixel that its history may make up
};
ParameterTable<ReprojectionParameters> reprojection_parameters();

/// What the fourth channel of an average is: of independent frames a variance falls as their number grows.
enum class FourthChannel { value, variance };

/// Declares the picture that `text` describes. `produce` declares a frame's picture by itself, as the text
/// that it is given says, of one or four float channels and the size of the view; without `reprojection` that
/// is all.
///
/// With it "KEY.frame" is what was produced, and the pass "reprojection" averages: exponentially along
/// `gbuffer.velocity`, at first as the plain mean of the frames there are. The first frame is `produce`'s,
/// bit by bit. Texels of the last frame count where they lie within a pixel's width of the plane in which the
/// point was then, and face the same way; where none does the average starts again.
graph::ImageRef reproject(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                          const std::function<graph::ImageRef(graph::ResourceText)>& produce,
                          const ReprojectionParameters& parameters, graph::ResourceText text,
                          FourthChannel fourth = FourthChannel::value);

/// "reprojection.frames".
std::vector<OutputDescription> reprojection_outputs();

}  // namespace ir::passes
