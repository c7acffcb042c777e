#include <optional>

#include "renderers/methods/photon-mapping/filtering/stages.h"
#include "renderers/passes/direct/compose.h"
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
    glm::vec3 background{0};
};

void declare_irradiance_reads(graph::PassBuilder& pass, const ComposeInputs& in) {
    pass.reads("value_image", in.filtered.irradiance)
        .reads("direction_image", in.filtered.direction)
        .reads(in.gbuffer.normal, in.gbuffer.geometric_normal);
}

void set_irradiance(const gl::Program& program, const ComposeInputs& in) {
    program.set("stretch_max", in.parameters.stretch_max);
    program.set("directional", in.parameters.directional ? 1 : 0);
}

/// The final irradiance, or what its directions say.
void show(graph::GraphBuilder& builder, const ComposeInputs& in, graph::ImageRef result,
          const std::string& name, const std::string& define) {
    auto pass = builder.pass(name);
    declare_irradiance_reads(pass, in);
    pass.writes("result", result);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{folder + "irradiance.comp"}};
        if (!define.empty()) source.defines[define] = "1";
        const auto& program = context.use(source);
        set_irradiance(program, in);
        dispatch_rows(context, program, slice);
    });
}

void set_view(const gl::Program& program, const scene::View& view) {
    const bool orthographic = view.clip_from_view[3][3] != 0;
    const auto axis = -glm::vec3(glm::transpose(view.view_from_world)[2]);
    program.set("eye_ws", view.eye_ws);
    program.set("view_axis_ws", orthographic ? axis : glm::vec3(0));
}

gl::ProgramSource radiance_source(const ComposeInputs& in) {
    gl::ProgramSource source{{folder + "radiance.comp"}};
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(in.parameters.transport.materials));
    if (in.has_indirect) source.defines["INDIRECT"] = "1";
    if (in.direct) source.defines["DIRECT"] = "1";
    if (in.has_emission) source.defines["EMISSION"] = "1";
    return source;
}

void reflect(graph::GraphBuilder& builder, const ComposeInputs& in) {
    const auto result = builder.output("radiance", {.format = gl::Format::rgba32f});
    auto pass = builder.pass("radiance");
    pass.reads(in.gbuffer.geometric_normal, in.gbuffer.albedo, in.gbuffer.material, in.gbuffer.position,
               in.scene.materials);
    if (in.has_indirect) declare_irradiance_reads(pass, in);
    if (in.direct) pass.reads("direct_image", in.direct->radiance);
    if (in.has_emission) pass.reads(in.gbuffer.emission);
    pass.writes("result", result);
    execute_by_rows(pass, group_rows(builder), [=](graph::PassContext& context, graph::Slice slice) {
        const auto& program = context.use(radiance_source(in));
        if (in.has_indirect) set_irradiance(program, in);
        set_view(program, context.inputs().view);
        program.set("background", in.background);
        dispatch_rows(context, program, slice);
    });
    passes::see_through_glass(builder, in.gbuffer, result);
}

}  // namespace

void compose(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
             const Filtered& filtered, const Parameters& parameters) {
    const auto paths = parameters.transport.paths;
    ComposeInputs in{scene, gbuffer, filtered, {}, parameters, paths != Paths::direct, paths == Paths::full};
    in.background = passes::visible_environment(builder, parameters.transport);
    if (paths != Paths::indirect)
        in.direct =
            passes::direct_light(builder, scene, gbuffer, {.materials = parameters.transport.materials});
    const auto irradiance = builder.output("irradiance", {.format = gl::Format::rgba32f});
    show(builder, in, irradiance, "irradiance", "");
    const auto flicker = builder.output("history.flicker", {.format = gl::Format::r32f});
    show(builder, in, flicker, "spread of directions", "FLICKER");
    reflect(builder, in);
}

}  // namespace ir::methods::photon_mapping
