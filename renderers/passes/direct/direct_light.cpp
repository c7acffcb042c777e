#include "renderers/passes/direct/direct_light.h"

#include <algorithm>

#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::passes {
namespace {

using graph::GraphBuilder;

void note_skipped_lights(GraphBuilder& builder) {
    const auto& lights = builder.inputs().world->lights;
    const auto skipped = std::count_if(lights.begin(), lights.end(), [](const scene::Light& light) {
        return light.type == scene::LightType::rectangle || light.type == scene::LightType::disk;
    });
    if (skipped == 0) return;
    builder.note("direct light leaves out " + std::to_string(skipped) + " rectangle or disk light" +
                 (skipped == 1 ? "" : "s") + ": shadow maps need lights without extent");
}

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
            .doc = "By rasterisation with shadow maps: reflected towards the eye, without emission."};
}

DirectLight direct_light(GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                         const DirectLightOptions& options) {
    note_skipped_lights(builder);
    note_many_materials(builder);
    const auto shadow = shadow_maps(builder, scene, options.shadow_resolution);
    const DirectLight result{
        builder.image({.text = graph::text_of(direct_output()), .format = gl::Format::rgba32f}), shadow};
    builder.pass("direct light")
        .reads(scene.materials, scene.lights, shadow.views, shadow.maps, gbuffer.position, gbuffer.normal,
               gbuffer.geometric_normal, gbuffer.albedo, gbuffer.material)
        .draw({{"passes/direct/direct_light.frag"},
               {{"MATERIALS", std::to_string(static_cast<int>(options.materials))}}},
              result.radiance,
              LightDirectly{viewer(builder.inputs().view),
                            static_cast<int>(builder.inputs().world->lights.size()),
                            options.shadow_filter_radius});
    return result;
}

}  // namespace ir::passes
