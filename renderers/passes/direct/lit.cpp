#include "renderers/passes/direct/lit.h"

#include "renderers/core/light_use.h"
#include "renderers/passes/gbuffer/glass.h"

namespace ir::passes {
namespace {

/// Constants of lit.comp.
struct Lit {
    float ambient;
    IR_FIELDS(ambient)
};

}  // namespace

OutputDescription lit_output() {
    return {.key = lit_output_key,
            .label = "Lit",
            .semantic = Semantic::radiance,
            .unit = "W/(m² sr)",
            .doc =
                "Direct light, emission, and ambient radiance times albedo times accessibility. The ambient "
                "radiance stands for the environment, which is left out."};
}

ParameterText ambient_parameter() {
    return {.key = "ambient",
            .label = "Ambient radiance",
            .doc = "Radiance from all directions that accessibility attenuates, in the output “lit”.",
            .unit = "W/(m² sr)",
            .hard = {0, 1e6},
            .soft = {0, 2}};
}

std::vector<MissingLight> missing_in_lit(std::vector<Condition> environment_when) {
    return {without_light_samples({LightPart::direct}, {LightKind::lamp, LightKind::surface}),
            {{LightPart::direct}, {LightKind::environment}, std::move(environment_when)}};
}

DirectLightOptions lit_options(const LightParameters& parameters) {
    return {.extended = {.parameters = parameters, .environment = false}};
}

graph::ImageRef lit(graph::GraphBuilder& builder, const GBuffer& gbuffer, const DirectLight& direct,
                    graph::ImageRef accessibility, float ambient, std::optional<graph::ImageRef> sky) {
    const auto result = builder.output(lit_output_key, {.format = gl::Format::rgba32f});
    auto pass = builder.pass("lit");
    gl::ProgramSource source{{"passes/direct/lit.comp"}};
    if (sky) source.defines["SKY"] = "1";
    pass.reads(sky ? "sky" : "accessibility", sky.value_or(accessibility))
        .reads("direct", direct.radiance)
        .reads(gbuffer.albedo, gbuffer.emission, gbuffer.geometric_normal);
    pass.writes("lit", result).compute(source, result, Lit{ambient});
    see_through_glass(builder, gbuffer, result);
    return result;
}

}  // namespace ir::passes
