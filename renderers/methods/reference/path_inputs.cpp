#include "renderers/methods/reference/passes.h"

#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/reference/light_tracer.h"
#include "renderers/passes/lights/light_sampler.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/lights/shining.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::methods::reference {
namespace {

/// Both are made anew in each frame: they point into scene and world.
graph::ObjectRef declare_surfaces(graph::GraphBuilder& builder, const Transport& transport) {
    const bool normal_maps = transport.normal_maps;
    const bool reflectance =
        transport.paths != Transport::Paths::ao && transport.materials != Transport::Materials::lambert;
    const auto result = builder.object(
        {.text = {
             .key = "reference.surfaces", .label = "Surfaces", .doc = "Materials and textures for rays."}});
    builder.pass("surfaces", graph::Queue::cpu).writes(result).execute([=](graph::PassContext& context) {
        const auto& inputs = context.inputs();
        const auto made =
            std::make_shared<passes::SurfaceLookup>(*inputs.scene, *inputs.world, normal_maps, reflectance);
        context.store(result, made, sizeof *made);
    });
    return result;
}

struct LightsText {
    const char *key, *label, *doc;
};

graph::ObjectRef declare_lights(graph::GraphBuilder& builder, graph::ObjectRef surfaces,
                                const LightsText& text, const passes::LightSamplerOptions& options) {
    const auto result = builder.object({.text = {.key = text.key, .label = text.label, .doc = text.doc}});
    builder.pass(text.label, graph::Queue::cpu)
        .reads(surfaces)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const auto lookup = context.object<passes::SurfaceLookup>(surfaces);
            const auto made = std::make_shared<passes::LightSampler>(*lookup, options);
            context.store(result, made, sizeof *made);
        });
    return result;
}

/// What the transport's choice of emitters means.
void declare_light_sources(graph::GraphBuilder& builder, const Transport& transport, PathInputs& inputs) {
    passes::LightSamplerOptions options;
    options.environment = transport.environment_light;
    options.lamps = options.emissive_meshes = transport.emitters != Transport::Emitters::none;
    inputs.lights = inputs.indirect_lights = declare_lights(
        builder, inputs.surfaces,
        {"reference.lights", "Light sources", "All that emits, with probabilities for choosing."}, options);
    if (transport.emitters != Transport::Emitters::direct) return;
    options.environment = options.lamps = options.emissive_meshes = false;
    inputs.indirect_lights = declare_lights(
        builder, inputs.surfaces,
        {"reference.indirect_lights", "Sources of indirect light", "The part whose light is scattered on."},
        options);
}

graph::ObjectRef declare_emission(graph::GraphBuilder& builder, graph::ObjectRef surfaces,
                                  const passes::EmissionOptions& sources) {
    const auto result = builder.object({.text = {.key = "reference.emission",
                                                 .label = "Emission",
                                                 .doc = "Where light is traced from, by power."}});
    builder.pass("emission", graph::Queue::cpu)
        .reads(surfaces)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const auto lookup = context.object<passes::SurfaceLookup>(surfaces);
            const auto made = std::make_shared<passes::EmissionSampler>(*lookup, sources);
            context.store(result, made, sizeof *made);
        });
    return result;
}

/// The G-buffer names a material in a half float.
void require_few_materials(const graph::FrameInputs& inputs) {
    const auto count = inputs.scene->materials.size();
    if (count <= passes::gbuffer_materials) return;
    throw UsageError("the scene has " + std::to_string(count) +
                     " materials, and primary=gbuffer tells only " +
                     std::to_string(passes::gbuffer_materials) + " apart; choose primary=rays");
}

passes::EmissionOptions traced_sources(const graph::FrameInputs& inputs, const Parameters& parameters) {
    auto sources = passes::shining_sources(inputs, parameters.transport);
    if (shares_light(parameters)) return sources;
    sources.environment = sources.emissive_meshes = false;
    std::erase_if(sources.lights, [&](int light) {
        return !passes::is_punctual(inputs.world->lights[static_cast<std::size_t>(light)]);
    });
    return sources;
}

}  // namespace

PathInputs path_inputs(graph::GraphBuilder& builder, const Parameters& parameters,
                       const SharpMaterials& materials) {
    const bool on_rays = parameters.primary == Primary::rays;
    const auto& transport = parameters.transport;
    PathInputs inputs;
    const bool is_light = transport.paths != Transport::Paths::ao;
    if (!on_rays) {
        if (is_light) require_few_materials(builder.inputs());
        inputs.gbuffer =
            passes::gbuffer(builder, passes::upload_scene(builder), passes::gbuffer_options(transport));
        inputs.valid = inputs.gbuffer->valid;
    }
    inputs.bvh = passes::bvh(builder);
    if (on_rays || is_light) inputs.surfaces = declare_surfaces(builder, transport);
    if (on_rays) inputs.valid = first_hits(builder, inputs.bvh, inputs.surfaces);
    if (!is_light) return inputs;
    declare_light_sources(builder, transport, inputs);
    const auto sources = traced_sources(builder.inputs(), parameters);
    if (LightTracer::has_paths(*builder.inputs().world, PathRules(transport), materials, sources,
                               shares_light(parameters)))
        inputs.emission = declare_emission(builder, inputs.surfaces, sources);
    return inputs;
}

}  // namespace ir::methods::reference
