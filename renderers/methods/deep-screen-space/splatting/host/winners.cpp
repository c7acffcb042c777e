#include "renderers/methods/deep-screen-space/splatting/host/winners.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <optional>

#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "renderers/passes/surface/triangle_plane.h"
#include "shaders/methods/deep-screen-space/splatting/exact.glsl.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Of the second and third corner of a triangle at a point in its plane, clamped to it.
glm::vec2 weights_at(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 position_ws) {
    const auto ab = b - a, ac = c - a, ap = position_ws - a;
    const auto n = glm::cross(ab, ac);
    const float area = glm::dot(n, n);
    if (area == 0) return glm::vec2(0);
    return glm::clamp(glm::vec2(glm::dot(glm::cross(ap, ac), n), glm::dot(glm::cross(ab, ap), n)) / area,
                      0.0f, 1.0f);
}

}  // namespace

Winners::Winners(const graph::PassContext& context, const VisibleSplats& visible)
    : world_(*context.inputs().world),
      black_backs_(visible.splats.parameters.backs == Backs::black),
      discs_{stored_surfels(context, visible.splats.surfels),
             context.elements<const SurfelLight>(visible.splats.surfels.lights),
             visible_level(visible.splats),
             visible.splats.hierarchy.levels,
             random_seed(context.inputs(), visible.splats.parameters),
             visible.splats.parameters.disc_light == DiscLight::averaged},
      width_(static_cast<std::size_t>(context.inputs().view.width)),
      positions_(context.pixels<const glm::vec4>(visible.gbuffer.position)) {}

Winners::Sender Winners::sender(std::uint32_t winner, glm::vec3 direction_ws, float distance_m,
                                std::size_t ray) const {
    const glm::vec3 x_ws(positions_[ray % pixels()]);
    if (winner & exact_hit) {
        const auto triangle = winner & ~exact_hit;
        const auto [a, b, c] = passes::triangle_corners(world_, triangle);
        const auto position_ws = x_ws + distance_m * direction_ws;
        return {.triangle = triangle,
                .is_exact = true,
                .weights = weights_at(a, b, c, position_ws),
                .position_ws = position_ws,
                .slope = glm::dot(passes::triangle_normal(a, b, c), direction_ws)};
    }
    const auto& surfel = discs_.surfels[winner - 1];
    return {.triangle = surfel.triangle,
            .surfel = winner - 1,
            .shell = discs_.shell(winner - 1, x_ws),
            .weights = glm::unpackUnorm2x16(surfel.barycentrics),
            .position_ws = surfel.centre_ws,
            .radius = surfel.radius,
            .slope = glm::dot(surfel.normal_ws, direction_ws)};
}

glm::vec3 Winners::stored(const Sender& sender, std::size_t ray) const {
    const auto pixel = ray % pixels();
    return discs_.sent(sender.surfel, sender.shell, sender.is_front(),
                       {pixel % width_, pixel / width_, ray / pixels()});
}

float Winners::slope_variance(const Sender& sender, const SenderSurfaces& surfaces,
                              const glm::vec4& direction, float distance_m) const {
    const float of_ray = surfaces.ray_slope_variance(sender.triangle, distance_m, direction.w);
    return sender.is_exact ? of_ray : of_ray + discs_.slope_variance(sender.surfel, sender.shell, distance_m);
}

SourceObjects source_objects(graph::GraphBuilder& builder, const Parameters& parameters) {
    if (!winners_are_sampled(builder.inputs(), parameters)) return {};
    return {passes::bvh(builder), sources_of(builder, parameters)};
}

WinnersSourceLight::WinnersSourceLight(const graph::PassContext& context, const SourceObjects& objects,
                                       const SenderSurfaces& surfaces, const Parameters& parameters)
    : surfaces_(surfaces),
      bvh_(context.object<passes::Bvh>(objects.bvh)),
      sources_(context.object<passes::ExtendedEmitters>(objects.sources)),
      irradiance_(*bvh_, *sources_, parameters),
      highlight_(*bvh_, *sources_, parameters),
      seed_(random_seed(context.inputs(), parameters)),
      mirrors_count_(parameters.transport.paths == Transport::Paths::full) {}

glm::vec3 WinnersSourceLight::sent(const Winners::Sender& sender, SenderSurfaces::Place place,
                                   glm::vec3 direction_ws, float variance, std::uint64_t ray) const {
    const auto key = passes::mixed(seed_ ^ ray ^ exact_hit);
    auto sum = sender.is_exact ? scattered(sender, place, direction_ws, key) : glm::vec3(0);
    auto& surface = place.surface;
    if (!surfaces_.are_glossy() || surface.is_unlit) return sum;
    if (!mirrors_count_ && surface.roughness * surface.roughness < passes::mirror_alpha) return sum;
    surface.position_ws = place.position_ws + place.lift * surface.geometric_normal_ws;
    const float gain = surfaces_.widen(surface, direction_ws, variance);
    return sum + gain * highlight_.radiance(surface, surfaces_.ior(surface), -direction_ws,
                                            passes::PathSampler(key, 1));
}

/// To all sides alike. Without normal maps, as SourceIrradiance has it.
glm::vec3 WinnersSourceLight::scattered(const Winners::Sender& sender, const SenderSurfaces::Place& place,
                                        glm::vec3 direction_ws, std::uint64_t key) const {
    const auto surface = sources_->surfaces.at(
        {.distance = 0, .triangle = sender.triangle, .u = sender.weights.x, .v = sender.weights.y},
        direction_ws);
    return surfaces_.of_extended(place.surface,
                                 irradiance_.irradiance(surface, surface.geometric_normal_ws, key, 1));
}

namespace {

/// What the device leaves to the host of the light of winners.
class SampledWinners {
  public:
    SampledWinners(const graph::PassContext& context, const SourceObjects& objects, graph::ObjectRef surfaces,
                   const VisibleSplats& visible)
        : senders_(context, surfaces, visible.splats.parameters),
          winners_(context, visible),
          light_(context, objects, senders_, visible.splats.parameters) {}

    glm::vec3 sent(std::uint32_t winner, const glm::vec4& direction, float distance_m,
                   std::size_t ray) const {
        const glm::vec3 direction_ws(direction);
        const auto sender = winners_.sender(winner, direction_ws, distance_m, ray);
        if (!winners_.shines(sender)) return glm::vec3(0);
        const auto place =
            senders_.place(sender.triangle, sender.weights, sender.position_ws, sender.radius, direction_ws);
        return light_.sent(sender, place, direction_ws,
                           winners_.slope_variance(sender, senders_, direction, distance_m), ray);
    }

  private:
    SenderSurfaces senders_;
    Winners winners_;
    WinnersSourceLight light_;
};

}  // namespace

void sample_winners_sources(graph::GraphBuilder& builder, const VisibleSplats& visible,
                            const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    const auto objects = source_objects(builder, parameters);
    const auto surfaces = passes::host_surfaces(builder, parameters.transport.normal_maps);
    auto pass = builder.pass("light samples of winners" + batch, graph::Queue::cpu);
    pass.reads(objects.bvh, objects.sources, surfaces);
    fill_by_winners(pass, builder, visible, visible.source_light, [=](const graph::PassContext& context) {
        return [light = std::make_shared<const SampledWinners>(context, objects, surfaces, visible)](
                   std::uint32_t winner, const glm::vec4& direction, float distance_m, std::size_t ray) {
            return light->sent(winner, direction, distance_m, ray);
        };
    });
}

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
