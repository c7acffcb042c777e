#include "renderers/passes/reflection/reflection.h"

namespace ir::passes {

ParameterTable<ReceiverParameters> receiver_parameters(int since_version, const Condition& highlights_when,
                                                       bool offers_full) {
    const auto in_older_projects = [&](Value value) {
        return since_version > 1 ? std::optional(std::move(value)) : std::nullopt;
    };
    std::vector<Choice> choices{
        {"diffuse", "Diffuse", "Without highlights; metals are black."},
        {"mean-direction", "Mean direction",
         "The whole BRDF, as if all light came from its mean direction. Highlights flicker."},
        {"widened", "Widened", "The same with highlights as wide as the directions of the light are apart."}};
    if (offers_full)
        choices.push_back(
            {"full", "Full",
             "The whole BRDF for each photon, where kernels are added up. The device gathers photons by tiles "
             "for it."});
    ParameterTable<ReceiverParameters> table;
    table
        .add(&ReceiverParameters::receiver,
             {.key = "receiver",
              .label = "Receivers",
              .doc = "How the surfaces that are seen reflect indirect light, of which each pixel knows the "
                     "irradiance and the mean direction.",
              .citation = "Smal19 §8.3",
              .choices = choices,
              .exact = offers_full ? std::vector<std::string>{"full"} : std::vector<std::string>{},
              .active_when = highlights_when,
              .since_version = since_version,
              .value_in_older_projects = in_older_projects(std::string("diffuse"))})
        .add(&ReceiverParameters::directional,
             {.key = "directional",
              .label = "Directional term",
              .doc = "Turns the irradiance of the geometric surface into that of the shading normal, as if "
                     "all light came from the mean direction of the photons.",
              .citation = "Smal19 §7.4",
              .since_version = since_version,
              .value_in_older_projects = in_older_projects(false)});
    return table;
}

void Reflection::define(gl::ProgramSource& source) const {
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(materials));
    if (light.has_whole_direction) source.defines["WHOLE_DIRECTION"] = "1";
    if (is_bare && parameters.receiver == Receiver::diffuse) source.defines["BARE"] = "1";
    source.defines["RECEIVER"] = std::to_string(static_cast<int>(parameters.receiver));
}

void Reflection::declare_reads_of_light(graph::PassBuilder& pass) const {
    pass.reads("value_image", light.irradiance)
        .reads("direction_image", light.direction)
        .reads(gbuffer.normal, gbuffer.geometric_normal);
}

void Reflection::declare_reads(graph::PassBuilder& pass) const {
    pass.reads(gbuffer.albedo, gbuffer.material, gbuffer.position, scene.materials);
}

ReflectionConstants Reflection::constants(const graph::FrameInputs& inputs) const {
    return {directional(), viewer(inputs.view)};
}

}  // namespace ir::passes
