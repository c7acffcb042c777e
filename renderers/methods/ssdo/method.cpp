// Screen-space directional occlusion and one bounce of indirect light: for each pixel steps of random length
// over the hemisphere, looked up in the picture. What is in front of a step's end occludes and sends its
// pixel's light. [Ritschel09]
#include "renderers/graph/method.h"

#include "renderers/methods/ssdo/passes.h"
#include "renderers/passes/direct/compose.h"

namespace ir::methods::ssdo {
namespace {

/// Samples light the pixels, which send what they show; the environment may come by directional occlusion.
std::vector<MissingLight> missing_light() {
    const std::vector<LightPart> parts{LightPart::direct, LightPart::indirect};
    auto environment = passes::without_light_samples(parts, {LightKind::environment});
    environment.active_when.push_back({"environment_by", {std::string("samples")}});
    return {passes::without_light_samples(parts, {LightKind::lamp, LightKind::surface}), environment};
}

MethodDescription description() {
    MethodDescription d;
    d.id = "ssdo";
    d.title = "Screen-space directional occlusion";
    d.summary =
        "Steps of random length over each pixel's hemisphere, looked up in the picture: what occludes one "
        "sends the light that its pixel shows; as published, what is open lets the environment's light in. "
        "Cheap and independent of the scene's size. What is hidden, beyond the picture's edge or turned away "
        "from the camera sends nothing, nothing in between shadows indirect light, and all surfaces are "
        "infinitely thick, unless depth peeling finds what lies behind them.";
    d.version = 3;
    d.papers = {"Ritschel09"};
    d.missing_light = missing_light();
    d.selectors = {sample_selector()};
    d.outputs = joined({{passes::radiance_output()},
                        passes::direct_outputs(),
                        light_outputs(),
                        gathered_outputs(),
                        explanation_outputs(),
                        {passes::valid_output()}});
    d.stages = {{"ssdo.indirect.raw", 0, "Before the blur"}, {"ssdo.indirect", 0, "Blurred"}};
    return d;
}

passes::DirectLightOptions direct_options(const Parameters& parameters) {
    auto extended = passes::extended_light_options(parameters.light, parameters.transport);
    extended.environment = extended.environment && parameters.environment_by == EnvironmentBy::samples;
    return {.extended = extended};
}

void note_what_is_left_out(graph::GraphBuilder& builder, const Inputs& inputs, bool lit_by_sky) {
    if (lit_by_sky)
        builder.note("ssdo: the environment lights by directional occlusion, so nothing beyond " +
                     std::to_string(inputs.reach) + " m keeps it out; environment_by=samples does");
    if (inputs.parameters.transport.max_distance == 0 && inputs.parameters.step_radius == 0)
        builder.note("ssdo: max_distance and step_radius are 0, so steps are up to " +
                     std::to_string(inputs.reach) +
                     " m long, the diagonal of the scene's bounds: few of many samples find what is near");
}

/// Whether open directions let an environment in.
bool has_sky(const graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto& environment = builder.inputs().scene->environment;
    return parameters.transport.environment_light && parameters.environment_by == EnvironmentBy::occlusion &&
           (environment.map != nullptr || environment.constant != glm::vec3(0));
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto light = direct_options(parameters);
    auto direct = passes::direct_light(builder, scene, gbuffer, light);
    const bool lit_by_sky = has_sky(builder, parameters);
    const Inputs inputs{scene,
                        gbuffer,
                        hidden_layers(builder, scene, gbuffer, parameters, light.extended),
                        environment(builder, lit_by_sky),
                        parameters,
                        reach_of(builder, parameters)};
    note_what_is_left_out(builder, inputs, lit_by_sky);
    const auto sky = blurred(builder, gbuffer, gather_sky(builder, inputs).raw, "ssdo.sky", parameters);
    const auto lit = add_sky(builder, gbuffer, direct, lit_by_sky ? &sky : nullptr);
    const auto raw = gather_indirect(builder, inputs, lit.senders);
    const auto indirect = blurred(builder, gbuffer, raw, "ssdo.indirect", parameters);
    explain(builder, inputs, lit.senders);
    direct.radiance = lit.seen;
    passes::compose_light(builder, gbuffer, direct, indirect, parameters.transport);
}

}  // namespace

const graph::Method& method() {
    static const auto method =
        graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
    return method;
}

}  // namespace ir::methods::ssdo
