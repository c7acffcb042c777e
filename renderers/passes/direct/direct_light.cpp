#include "renderers/passes/direct/direct_light.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::passes {
namespace {

using graph::GraphBuilder;
using graph::PassContext;

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

void set_light(const PassContext& p, const gl::Program& program, const DirectLightOptions& options) {
    const auto& view = p.inputs().view;
    const bool orthographic = view.clip_from_view[3][3] != 0;
    const auto axis = -glm::vec3(glm::transpose(view.view_from_world)[2]);
    program.set("light_count", static_cast<int>(p.inputs().world->lights.size()));
    program.set("shadow_filter_radius", options.shadow_filter_radius);
    program.set("eye_ws", view.eye_ws);
    program.set("view_axis_ws", orthographic ? axis : glm::vec3(0));
}

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
              result.radiance, [options](const PassContext& p, const gl::Program& program) {
                  set_light(p, program, options);
              });
    return result;
}

}  // namespace ir::passes
