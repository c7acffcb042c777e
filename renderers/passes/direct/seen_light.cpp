#include "renderers/passes/direct/seen_light.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/scene/light_sources.h"

namespace ir::passes {
namespace {

/// Rays through the pixels' centres, up to the surface.
class SeenAlongRays {
  public:
    SeenAlongRays(const graph::FrameInputs& inputs, bool map) : rays_(pixel_rays(inputs.view)) {
        for (const auto& light : inputs.world->lights)
            if (scene::is_flat(light)) lights_.emplace_back(light);
        if (map) environment_.emplace(inputs.scene->environment);
    }

    glm::vec3 at(int x, int y, glm::vec4 position) const {
        const float u = static_cast<float>(x) + 0.5f, v = static_cast<float>(y) + 0.5f;
        const auto origin = rays_.origin + u * rays_.origin_dx + v * rays_.origin_dy;
        const auto direction =
            glm::normalize(rays_.direction + u * rays_.direction_dx + v * rays_.direction_dy);
        const bool is_surface = position.w > 0;
        const float far =
            is_surface ? glm::distance(glm::vec3(position), origin) : std::numeric_limits<float>::infinity();
        glm::vec3 sum(0);
        for (const auto& light : lights_)
            if (light.intersect(origin, direction, far)) sum += light.radiance();
        if (environment_ && !is_surface) sum += environment_->radiance(direction);
        return sum;
    }

  private:
    PixelRays rays_;
    std::vector<FlatLight> lights_;
    std::optional<EnvironmentLight> environment_;
};

graph::ImageRef draw_seen(graph::GraphBuilder& builder, const GBuffer& gbuffer, bool map) {
    const auto result = builder.image({.text = {.key = "direct.seen",
                                                .label = "Seen light",
                                                .doc = "Rectangles and disks before what is seen, and the "
                                                       "environment map behind everything.",
                                                .semantic = Semantic::radiance,
                                                .unit = "W/(m² sr)"},
                                       .format = gl::Format::rgba32f});
    builder.pass("seen light", graph::Queue::cpu)
        .reads(gbuffer.position)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const SeenAlongRays seen(context.inputs(), map);
            const auto positions = context.pixels<glm::vec4>(gbuffer.position);
            const auto pixels = context.pixels<glm::vec4>(result);
            const int width = context.inputs().view.width;
            for (std::size_t i = 0; i < pixels.size(); ++i)
                pixels[i] = glm::vec4(
                    seen.at(static_cast<int>(i) % width, static_cast<int>(i) / width, positions[i]), 1);
        });
    return result;
}

}  // namespace

SeenLight seen_light(graph::GraphBuilder& builder, const GBuffer& gbuffer, const Transport& transport) {
    if (transport.paths != Transport::Paths::full) return {};
    const auto& inputs = builder.inputs();
    const auto& environment = inputs.scene->environment;
    SeenLight seen;
    const bool map = transport.environment_light && environment.map;
    if (transport.environment_light && !map) seen.background = environment.constant;
    if (map || std::ranges::any_of(inputs.world->lights, scene::is_flat))
        seen.image = draw_seen(builder, gbuffer, map);
    return seen;
}

}  // namespace ir::passes
