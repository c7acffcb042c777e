#include "renderers/methods/ldm-indirect/tracing/light_images.h"

#include <algorithm>

#include "renderers/passes/scene/light_data.h"

namespace ir::methods::ldm_indirect {
namespace {

std::string counted(int count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> LightViews::notes() const {
    std::string missing;
    const auto add = [&](const std::string& part) { missing += (missing.empty() ? "" : ", ") + part; };
    if (areas > 0) add(counted(areas, "rectangle or disk light"));
    if (emissive_triangles > 0) add(counted(emissive_triangles, "emissive triangle"));
    if (has_environment) add("the environment");
    std::vector<std::string> result;
    if (views.empty()) result.push_back("no point, spot or directional light: there are no photons");
    if (!missing.empty())
        result.push_back("photons come from point, spot and directional lights only; none from " + missing);
    if (beyond > 0)
        result.push_back("photons come from the first " + std::to_string(max_lights) + " lights or " +
                         std::to_string(max_layers) + " images; " + counted(beyond, "light") +
                         " beyond emit none");
    return result;
}

LightViews views_of_lights(const scene::Scene& scene, const scene::World& world, int resolution) {
    LightViews result;
    int end = 0;  // lights before this one emit
    for (int layers = 0; end < std::min<int>(static_cast<int>(world.lights.size()), max_lights); ++end) {
        layers += passes::shadow_layers(world.lights[static_cast<std::size_t>(end)]);
        if (layers > max_layers) break;
    }
    for (int i = 0; i < static_cast<int>(world.lights.size()); ++i) {
        const bool is_punctual = passes::shadow_layers(world.lights[static_cast<std::size_t>(i)]) > 0;
        result.areas += !is_punctual;
        result.beyond += is_punctual && i >= end;
    }
    for (const auto& view : passes::shadow_views(world, resolution))
        if (view.light < end) result.views.push_back(view);
    for (const auto& range : world.ranges) {
        const auto& emission = scene.materials.at(static_cast<std::size_t>(range.material)).emission;
        if (std::max({emission.r, emission.g, emission.b}) > 0)
            result.emissive_triangles += static_cast<int>(range.triangle_count);
    }
    result.has_environment = scene.environment.map != nullptr || scene.environment.constant != glm::vec3(0);
    return result;
}

passes::Rsm draw_light_images(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const Parameters& parameters) {
    const auto& inputs = builder.inputs();
    const auto lights = views_of_lights(*inputs.scene, *inputs.world, parameters.emission);
    for (const auto& note : lights.notes()) builder.note(note);
    return passes::draw_rsm(builder, scene,
                            {.views = lights.views,
                             .resolution = parameters.emission,
                             .opaque_only = parameters.transport.materials == Transport::Materials::lambert,
                             .normal_maps = parameters.transport.normal_maps,
                             .geometric_normal = true,
                             .exact_albedo = true});
}

}  // namespace ir::methods::ldm_indirect
