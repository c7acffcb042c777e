#include "renderers/methods/ldm-indirect/tracing/emission.h"

#include <algorithm>

#include "renderers/passes/sampling/point_sequence.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::methods::ldm_indirect {
namespace {

/// So that photons of another frame start elsewhere. Turned by other numbers than the maps: else the
/// directions would keep their angles to the photons in all frames.
passes::ViewJitter jitter_of(const graph::FrameInputs& inputs, const Parameters& parameters) {
    if (!parameters.progressive) return {};
    const auto seed = photon_seed(inputs, parameters);
    return {passes::PathSampler(seed, 0).pair(0) - 0.5f, glm::mat3(passes::ldm::random_rotation(seed, 0))};
}

}  // namespace

LightViews views_of_lights(const scene::World& world, int resolution, const passes::ViewJitter& jitter) {
    LightViews result;
    int end = 0;  // lights before this one emit
    for (int layers = 0; end < std::min<int>(static_cast<int>(world.lights.size()), max_lights); ++end) {
        layers += passes::shadow_layers(world.lights[static_cast<std::size_t>(end)]);
        if (layers > max_layers) break;
    }
    for (auto i = static_cast<std::size_t>(end); i < world.lights.size(); ++i)
        result.beyond += passes::shadow_layers(world.lights[i]) > 0;
    for (const auto& view : passes::shadow_views(world, resolution, jitter))
        if (view.light < end) result.views.push_back(view);
    return result;
}

passes::Rsm draw_light_images(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const Parameters& parameters) {
    const auto& inputs = builder.inputs();
    const auto lights = views_of_lights(*inputs.world, parameters.emission, jitter_of(inputs, parameters));
    if (lights.beyond > 0)
        builder.note("photons come from the first " + std::to_string(max_lights) + " lights or " +
                     std::to_string(max_layers) + " images; " + std::to_string(lights.beyond) +
                     (lights.beyond == 1 ? " light" : " lights") + " beyond emit none");
    return passes::draw_rsm(builder, scene,
                            {.views = lights.views,
                             .resolution = parameters.emission,
                             .opaque_only = parameters.transport.materials == Transport::Materials::lambert,
                             .normal_maps = parameters.transport.normal_maps,
                             .geometric_normal = true,
                             .exact_albedo = true,
                             .views_differ = parameters.progressive});
}

}  // namespace ir::methods::ldm_indirect
