#include <optional>

#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/direct/seen_light.h"
#include "renderers/passes/gbuffer/glass.h"

namespace ir::methods::photon_mapping {
namespace {

using Paths = Transport::Paths;

struct ComposeInputs {
    passes::Reflection reflection;
    std::optional<passes::DirectLight> direct;
    bool has_indirect, has_emission;
    passes::SeenLight seen = {};
};

/// The final irradiance, or what its directions say.
void show(graph::GraphBuilder& builder, const ComposeInputs& in, graph::ImageRef result,
          const std::string& name, const std::string& define) {
    auto pass = builder.pass(name);
    in.reflection.declare_reads_of_light(pass);
    pass.writes("result", result);
    gl::ProgramSource source{{folder + "irradiance.comp"}};
    if (!define.empty()) source.defines[define] = "1";
    compute_by_rows(pass, builder, source, in.reflection.directional());
}

gl::ProgramSource radiance_source(const ComposeInputs& in) {
    gl::ProgramSource source{{folder + "radiance.comp"}};
    in.reflection.define(source);
    if (in.has_indirect) source.defines["INDIRECT"] = "1";
    if (in.direct) source.defines["DIRECT"] = "1";
    if (in.has_emission) source.defines["EMISSION"] = "1";
    if (in.seen.image) source.defines["SEEN"] = "1";
    return source;
}

/// Constants of radiance.comp.
struct Reflect {
    passes::ReflectionConstants reflection;
    glm::vec3 background;
    IR_FIELDS(reflection, background)
};

void reflect(graph::GraphBuilder& builder, const ComposeInputs& in) {
    const auto result = builder.output("radiance", {.format = gl::Format::rgba32f});
    auto pass = builder.pass("radiance");
    in.reflection.declare_reads(pass);
    if (in.has_indirect)
        in.reflection.declare_reads_of_light(pass);
    else
        pass.reads(in.reflection.gbuffer.geometric_normal);
    if (in.direct) pass.reads("direct_image", in.direct->radiance);
    if (in.has_emission) pass.reads(in.reflection.gbuffer.emission);
    if (in.seen.image) pass.reads("seen_image", *in.seen.image);
    pass.writes("result", result);
    compute_by_rows(pass, builder, radiance_source(in),
                    Reflect{in.reflection.constants(builder.inputs()), in.seen.background});
    passes::see_through_glass(builder, in.reflection.gbuffer, result);
}

}  // namespace

void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const passes::ArrivedLight& filtered, const Parameters& parameters) {
    const auto paths = parameters.transport.paths;
    ComposeInputs in{.reflection = {.scene = scene,
                                    .gbuffer = gbuffer,
                                    .light = filtered,
                                    .parameters = parameters.receivers,
                                    .materials = parameters.transport.materials,
                                    .max_stretch = parameters.max_stretch},
                     .direct = {},
                     .has_indirect = paths != Paths::direct,
                     .has_emission = paths == Paths::full};
    in.seen = passes::seen_light(builder, gbuffer, parameters.transport);
    const auto direct = passes::direct_light(
        builder, scene, gbuffer,
        {.extended = passes::extended_light_options(parameters.light, parameters.transport)});
    if (paths != Paths::indirect) in.direct = direct;
    const auto irradiance = builder.output("irradiance", {.format = gl::Format::rgba32f});
    show(builder, in, irradiance, "irradiance", "");
    if (!parameters.reflects_each_photon()) {
        const auto flicker = builder.output("history.flicker", {.format = gl::Format::r32f});
        show(builder, in, flicker, "spread of directions", "FLICKER");
    }
    reflect(builder, in);
}

}  // namespace ir::methods::photon_mapping
