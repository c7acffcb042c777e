#include <optional>

#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/direct/seen_light.h"
#include "renderers/passes/gbuffer/glass.h"

namespace ir::methods::photon_mapping {
namespace {

using Paths = Transport::Paths;

struct ComposeInputs {
    passes::SceneBuffers scene;
    passes::GBuffer gbuffer;
    Filtered filtered;
    std::optional<passes::DirectLight> direct;
    Parameters parameters;
    bool has_indirect, has_emission;
    passes::SeenLight seen = {};
};

void declare_irradiance_reads(graph::PassBuilder& pass, const ComposeInputs& in) {
    pass.reads("value_image", in.filtered.irradiance)
        .reads("direction_image", in.filtered.direction)
        .reads(in.gbuffer.normal, in.gbuffer.geometric_normal);
}

/// Constants of directional.glsl.
struct Directional {
    float max_stretch;
    bool directional;
    IR_FIELDS(max_stretch, directional)
};

Directional directional(const Parameters& parameters) {
    return {parameters.max_stretch, parameters.directional};
}

/// The final irradiance, or what its directions say.
void show(graph::GraphBuilder& builder, const ComposeInputs& in, graph::ImageRef result,
          const std::string& name, const std::string& define) {
    auto pass = builder.pass(name);
    declare_irradiance_reads(pass, in);
    pass.writes("result", result);
    gl::ProgramSource source{{folder + "irradiance.comp"}};
    if (!define.empty()) source.defines[define] = "1";
    compute_by_rows(pass, builder, source, directional(in.parameters));
}

gl::ProgramSource radiance_source(const ComposeInputs& in) {
    gl::ProgramSource source{{folder + "radiance.comp"}};
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(in.parameters.transport.materials));
    source.defines["RECEIVER"] = std::to_string(static_cast<int>(in.parameters.receiver));
    if (in.has_indirect) source.defines["INDIRECT"] = "1";
    if (in.direct) source.defines["DIRECT"] = "1";
    if (in.has_emission) source.defines["EMISSION"] = "1";
    if (in.seen.image) source.defines["SEEN"] = "1";
    return source;
}

/// Constants of radiance.comp.
struct Reflect {
    Directional directional;
    passes::Viewer viewer;
    glm::vec3 background;
    IR_FIELDS(directional, viewer, background)
};

void reflect(graph::GraphBuilder& builder, const ComposeInputs& in) {
    const auto result = builder.output("radiance", {.format = gl::Format::rgba32f});
    auto pass = builder.pass("radiance");
    pass.reads(in.gbuffer.geometric_normal, in.gbuffer.albedo, in.gbuffer.material, in.gbuffer.position,
               in.scene.materials);
    if (in.has_indirect) declare_irradiance_reads(pass, in);
    if (in.direct) pass.reads("direct_image", in.direct->radiance);
    if (in.has_emission) pass.reads(in.gbuffer.emission);
    if (in.seen.image) pass.reads("seen_image", *in.seen.image);
    pass.writes("result", result);
    compute_by_rows(
        pass, builder, radiance_source(in),
        Reflect{directional(in.parameters), passes::viewer(builder.inputs().view), in.seen.background});
    passes::see_through_glass(builder, in.gbuffer, result);
}

}  // namespace

void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const Filtered& filtered, const Parameters& parameters) {
    const auto paths = parameters.transport.paths;
    ComposeInputs in{scene, gbuffer, filtered, {}, parameters, paths != Paths::direct, paths == Paths::full};
    in.seen = passes::seen_light(builder, gbuffer, parameters.transport);
    const auto direct = passes::direct_light(
        builder, scene, gbuffer,
        {.extended = passes::extended_light_options(parameters.light, parameters.transport)});
    if (paths != Paths::indirect) in.direct = direct;
    const auto irradiance = builder.output("irradiance", {.format = gl::Format::rgba32f});
    show(builder, in, irradiance, "irradiance", "");
    const auto flicker = builder.output("history.flicker", {.format = gl::Format::r32f});
    show(builder, in, flicker, "spread of directions", "FLICKER");
    reflect(builder, in);
}

}  // namespace ir::methods::photon_mapping
