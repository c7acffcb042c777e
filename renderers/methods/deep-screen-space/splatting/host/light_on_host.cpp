#include "renderers/methods/deep-screen-space/splatting/visible.h"

#include <algorithm>
#include <optional>

#include "renderers/methods/deep-screen-space/splatting/host/winners.h"
#include "renderers/passes/surface/host_surfaces.h"

namespace ir::methods::deep_screen_space {
namespace {

/// The senders of a frame.
class HostLight {
  public:
    HostLight(const graph::PassContext& context, graph::ObjectRef surfaces, const SourceObjects& objects,
              const VisibleSplats& visible)
        : senders_(context, surfaces, visible.shadow, visible.splats.parameters), winners_(context, visible) {
        if (objects.are_there()) sources_.emplace(context, objects, senders_, visible.splats.parameters);
        if (visible.splats.open_glass) glass_.emplace(*context.inputs().scene, *context.inputs().world);
    }

    /// By what "splats.nearest" says of a ray.
    glm::vec3 sent(std::uint32_t winner, const glm::vec4& direction, float distance_m,
                   std::size_t ray) const {
        const glm::vec3 direction_ws(direction);
        const auto sender = winners_.sender(winner, direction_ws, distance_m, ray);
        if (!winners_.shines(sender)) return glm::vec3(0);
        auto radiance = sender.is_exact ? glm::vec3(0) : winners_.stored(sender, ray);
        if (sender.is_exact || senders_.are_glossy()) {
            const auto place = senders_.place(sender.triangle, sender.weights, sender.position_ws,
                                              sender.radius, direction_ws);
            const float variance = winners_.slope_variance(sender, senders_, direction, distance_m);
            radiance += sender.is_exact ? senders_.all(place, direction_ws, variance)
                                        : senders_.glossy_rest(place, direction_ws, variance);
            radiance = glm::max(radiance, glm::vec3(0));
            if (sources_) radiance += sources_->sent(sender, place, direction_ws, variance, ray);
        }
        // Of the rays, those that glass stops send what all of them would meet of its opaque part.
        if (!glass_) return radiance;
        return radiance / std::max(1 - glass_->passed_by_glass(sender.triangle, sender.slope), 1e-6f);
    }

  private:
    HostSenders senders_;
    Winners winners_;
    std::optional<WinnersSourceLight> sources_;
    std::optional<HostGlass> glass_;
};

}  // namespace

void resolve_light_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible,
                           const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    const auto objects = source_objects(builder, parameters);
    const auto surfaces = passes::host_surfaces(builder, parameters.transport.normal_maps);
    const auto& shadow = visible.shadow;
    auto pass = builder.pass("light of the winners" + batch, graph::Queue::cpu);
    pass.has_two_bodies().reads(surfaces, shadow.maps, shadow.panes);
    if (objects.are_there()) pass.reads(objects.bvh, objects.sources);
    fill_by_winners(pass, builder, visible, visible.samples.incoming, [=](const graph::PassContext& context) {
        return [light = std::make_shared<const HostLight>(context, surfaces, objects, visible)](
                   std::uint32_t winner, const glm::vec4& direction, float distance_m, std::size_t ray) {
            return light->sent(winner, direction, distance_m, ray);
        };
    });
}

}  // namespace ir::methods::deep_screen_space
