#include "renderers/passes/direct/direct_light.h"

#include "renderers/passes/direct/direct_light_on_host.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::passes {
namespace {

using graph::GraphBuilder;

void note_many_materials(GraphBuilder& builder) {
    const auto count = builder.inputs().scene->materials.size();
    if (count <= gbuffer_materials) return;
    builder.note("the scene has " + std::to_string(count) + " materials, of which the G-buffer tells " +
                 std::to_string(gbuffer_materials) +
                 " apart: direct light may take the index of refraction of another one");
}

/// Constants of direct_light.frag.
struct LightDirectly {
    Viewer viewer;
    int light_count, shadow_filter_radius;
    IR_FIELDS(viewer, light_count, shadow_filter_radius)
};

}  // namespace

OutputDescription direct_output() {
    return {.key = "direct.radiance",
            .label = "Direct light",
            .semantic = Semantic::radiance,
            .unit = "W/(m² sr)",
            .doc =
                "Reflected towards the eye, without emission: of point, spot and directional lights by "
                "shadow maps (on the host by rays), of rectangles, disks, emissive meshes and the "
                "environment by samples."};
}

std::vector<OutputDescription> direct_outputs() {
    auto all = extended_light_outputs();
    all.insert(all.begin(), direct_output());
    return all;
}

ExtendedLightOptions extended_light_options(const LightParameters& parameters, const Transport& transport) {
    return {.parameters = parameters,
            .materials = transport.materials,
            .environment = transport.environment_light,
            .mirrors = transport.paths == Transport::Paths::full};
}

DirectLight direct_light(GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                         const DirectLightOptions& options) {
    note_many_materials(builder);
    const auto extended = extended_light(builder, scene, gbuffer, options.extended);
    const auto shadow = shadow_maps(builder, scene, options.shadow_resolution, options.extended.materials);
    const DirectLight result{
        builder.image({.text = graph::text_of(direct_output()), .format = gl::Format::rgba32f}), shadow};
    // Rays give sharp shadows only.
    const bool has_two_bodies = options.shadow_filter_radius == 0;
    if (has_two_bodies && builder.inputs().processor == Processor::host) {
        direct_light_on_host(builder, gbuffer, options.extended.materials, extended, result.radiance);
        return result;
    }
    gl::ProgramSource source{{"passes/direct/direct_light.frag"},
                             {{"MATERIALS", std::to_string(static_cast<int>(options.extended.materials))}}};
    auto pass = builder.pass("direct light");
    if (has_two_bodies) pass.has_two_bodies();
    shadow.read_by(pass);
    pass.reads(scene.materials, scene.lights, gbuffer.position, gbuffer.normal, gbuffer.geometric_normal,
               gbuffer.albedo, gbuffer.material);
    if (extended) {
        source.defines["EXTENDED"] = "1";
        pass.reads("extended_light", *extended);
    }
    pass.draw(
        source, result.radiance,
        LightDirectly{viewer(builder.inputs().view), static_cast<int>(builder.inputs().world->lights.size()),
                      options.shadow_filter_radius});
    return result;
}

}  // namespace ir::passes
