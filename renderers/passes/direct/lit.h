#pragma once

#include <optional>

#include "renderers/core/output.h"
#include "renderers/core/parameter.h"
#include "renderers/passes/direct/direct_light.h"

namespace ir::passes {

/// What a method of ambient occlusion says of its output "lit", and of the parameter behind it.
OutputDescription lit_output();
ParameterText ambient_parameter();

/// Light that it lacks: what is not sampled, and the environment, but for methods and settings that let it in
/// another way.
std::vector<MissingLight> missing_in_lit(std::vector<Condition> environment_when = {});

/// The direct light of "lit": without the environment, for which the ambient radiance stands.
DirectLightOptions lit_options(const LightParameters& parameters);

/// Declares the pass and the output "lit", rgba32f in W/(m² sr): direct light, emission, and `ambient`
/// radiance from everywhere as far as `accessibility` (r32f) lets it in. Background 0. With `sky` (rgba32f),
/// what a white Lambertian surface reflects of the environment, that stands in place of the ambient radiance.
graph::ImageRef lit(graph::GraphBuilder& builder, const GBuffer& gbuffer, const DirectLight& direct,
                    graph::ImageRef accessibility, float ambient, std::optional<graph::ImageRef> sky = {});

}  // namespace ir::passes
