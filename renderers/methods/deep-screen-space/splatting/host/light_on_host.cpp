#include "renderers/methods/deep-screen-space/splatting/visible.h"

#include <tbb/blocked_range.h>

#include <glm/gtc/packing.hpp>
#include <optional>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/image_layers.h"
#include "renderers/methods/deep-screen-space/splatting/host/disc_light.h"
#include "renderers/methods/deep-screen-space/splatting/level0_light.h"
#include "renderers/methods/deep-screen-space/surfels/host/host_senders.h"
#include "renderers/passes/surface/host_surfaces.h"

namespace ir::methods::deep_screen_space {
namespace {

/// What the pass reads besides images and buffers.
struct Objects {
    graph::ObjectRef surfaces, bvh, sources;  ///< the last two only with sources with an extent
    bool has_sources() const { return sources.index >= 0; }
};

/// The senders of a frame.
class HostLight {
  public:
    HostLight(const graph::PassContext& context, const Objects& objects, const VisibleSplats& visible)
        : world_(*context.inputs().world),
          parameters_(visible.splats.parameters),
          senders_(context, objects.surfaces, visible.shadow, parameters_),
          is_glossy_(sends_highlights(parameters_)),
          discs_{stored_surfels(context, visible.splats.surfels),
                 context.elements<const SurfelLight>(visible.splats.surfels.lights),
                 visible_level(visible.splats),
                 visible.splats.hierarchy.levels,
                 random_seed(context.inputs(), parameters_),
                 parameters_.disc_light == DiscLight::averaged},
          width_(static_cast<std::size_t>(context.inputs().view.width)),
          positions_(context.pixels<const glm::vec4>(visible.gbuffer.position)) {
        if (objects.has_sources()) level0_.emplace(context, objects.bvh, objects.sources, parameters_);
    }

    std::size_t pixels() const { return positions_.size(); }

    /// By what "splats.nearest" says of a sample. `ray`: its number among all, which is that of its pixel
    /// and as many for each layer before as there are pixels.
    glm::vec3 sent(std::uint32_t winner, const glm::vec4& direction, float distance, std::size_t ray) const {
        const glm::vec3 direction_ws(direction);
        if (winner & exact_hit) return sent_by_triangle(winner & ~exact_hit, direction, distance, ray);
        const auto& surfel = discs_.surfels[winner - 1];
        const bool is_front = glm::dot(surfel.normal_ws, direction_ws) <= 0;
        if (!is_front && parameters_.backs == Backs::black) return glm::vec3(0);
        const auto pixel = ray % pixels();
        const int shell = discs_.shell(winner - 1, positions_[pixel]);
        const auto radiance =
            discs_.sent(winner - 1, shell, is_front, {pixel % width_, pixel / width_, ray / pixels()});
        if (!is_glossy_) return radiance;
        const auto place = senders_.place(surfel.triangle, glm::unpackUnorm2x16(surfel.barycentrics),
                                          surfel.centre_ws, surfel.radius, direction_ws);
        const float variance = discs_.slope_variance(winner - 1, shell, distance) +
                               senders_.ray_slope_variance(surfel.triangle, distance, direction.w);
        return glm::max(radiance + senders_.glossy_rest(place, direction_ws, variance), glm::vec3(0));
    }

  private:
    glm::vec3 sent_by_triangle(std::uint32_t triangle, const glm::vec4& direction, float distance,
                               std::size_t ray) const {
        const glm::vec3 direction_ws(direction);
        const auto position = glm::vec3(positions_[ray % pixels()]) + distance * direction_ws;
        const auto weights = weights_at(world_, triangle, position);
        const auto place = senders_.place(triangle, weights, position, 0, direction_ws);
        if (parameters_.backs == Backs::black && !place.surface.is_front) return glm::vec3(0);
        const auto extended =
            level0_ ? level0_->irradiance(triangle, weights, direction_ws, ray) : glm::vec3(0);
        const float variance = senders_.ray_slope_variance(triangle, distance, direction.w);
        return glm::max(senders_.all(place, direction_ws, extended, variance), glm::vec3(0));
    }

    const scene::World& world_;
    Parameters parameters_;
    HostSenders senders_;
    bool is_glossy_;
    DiscLights discs_;
    std::size_t width_;
    std::span<const glm::vec4> positions_;
    std::optional<Level0Light> level0_;
};

constexpr std::int64_t block = 256;  // pixels that a thread does at a time

}  // namespace

void resolve_light_on_host(graph::GraphBuilder& builder, const VisibleSplats& visible,
                           const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    Objects objects{passes::host_surfaces(builder, parameters.transport.normal_maps), {}, {}};
    if (parameters.level0 == Level0::triangles && has_sources(builder.inputs(), parameters)) {
        objects.bvh = passes::bvh(builder);
        objects.sources = sources_of(builder, parameters);
    }
    const auto distance = visible.samples.distance, incoming = visible.samples.incoming;
    const auto& shadow = visible.shadow;
    auto pass = builder.pass("light of the winners" + batch, graph::Queue::cpu);
    pass.has_two_bodies()
        .reads(objects.surfaces, shadow.maps, shadow.panes, visible.splats.surfels.records,
               visible.splats.surfels.stored, visible.splats.surfels.lights, visible.gbuffer.position,
               visible.nearest, distance, visible.directions.directions)
        .writes(incoming);
    if (objects.has_sources()) pass.reads(objects.bvh, objects.sources);
    const auto& view = builder.inputs().view;
    const auto pixels = std::int64_t{view.width} * view.height;
    const auto blocks = (pixels + block - 1) / block;
    pass.execute_sliced(
        blocks * visible.splats.samples, [=](graph::PassContext& context, graph::Slice slice) {
            const HostLight light(context, objects, visible);
            const auto first_sample = static_cast<std::size_t>(visible.splats.first_sample);
            const auto winners = graph::layers<const std::uint32_t>(context, visible.nearest);
            const auto distances = graph::layers<const float>(context, distance);
            const auto directions = graph::layers<const glm::vec4>(context, visible.directions.directions);
            const auto results = graph::layers<glm::vec4>(context, incoming);
            const auto fill = [&](std::int64_t item) {
                const auto layer = static_cast<std::size_t>(item / blocks);
                const auto first = static_cast<std::size_t>(item % blocks * block);
                for (auto i = first; i < std::min(light.pixels(), first + block); ++i) {
                    const auto winner = winners[layer][i];
                    auto& result = results[layer][i];
                    result = glm::vec4(0);
                    if (winner == 0) continue;
                    const auto ray = light.pixels() * (first_sample + layer) + i;
                    result = glm::vec4(light.sent(winner, directions[layer][i], distances[layer][i], ray), 1);
                }
            };
            parallel_for(context.inputs().threads, slice.begin, slice.end, fill);
        });
}

}  // namespace ir::methods::deep_screen_space
