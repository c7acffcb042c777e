#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <span>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/surfels/host/host_senders.h"
#include "renderers/methods/deep-screen-space/surfels/senders.h"
#include "renderers/passes/raytracing/open_part.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "shaders/methods/deep-screen-space/surfels/stored.comp.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Of surfels, which are discs.
class SurfelIrradiance {
  public:
    SurfelIrradiance(const passes::Bvh& bvh, const passes::ExtendedEmitters& sources, std::uint64_t seed,
                     const Parameters& parameters)
        : bvh_(bvh),
          surfaces_(sources.surfaces),
          sources_(bvh, sources, parameters),
          seed_(seed),
          samples_(parameters.sender_samples),
          light_offset_(parameters.light_offset),
          lights_backs_(parameters.backs == Backs::lit) {}

    SurfelLight of(const Surfel& surfel) const {
        SurfelLight light{};
        const auto front = side(surfel, surfel.normal_ws, 0);
        const auto back = lights_backs_ ? side(surfel, -surfel.normal_ws, 1) : glm::vec3(0);
        for (int c = 0; c < 3; ++c) light.front[c] = front[c], light.back[c] = back[c];
        return light;
    }

  private:
    glm::vec3 side(const Surfel& surfel, const glm::vec3& normal, std::uint64_t number) const {
        const auto weights = glm::unpackUnorm2x16(surfel.barycentrics);
        auto surface = surfaces_.at(
            {.distance = 0, .triangle = surfel.triangle, .u = weights.x, .v = weights.y}, -normal);
        surface.position_ws = surfel.centre_ws + light_offset_ * surfel.radius * normal;
        const auto key = passes::mixed(seed_ ^ (std::uint64_t{surfel.identity} << 1 | number));
        const auto sum = sources_.irradiance(surface, normal, key, samples_);
        return sum == glm::vec3(0) ? sum : out_of_gaps(surface, surfel.radius, key) * sum;
    }
    /// Discs do not see what lies within a radius.
    float out_of_gaps(const passes::Surface& surface, float radius, std::uint64_t key) const {
        const auto origin = passes::offset_origin(surface.position_ws, surface.geometric_normal_ws);
        if (!bvh_.occluded(origin, surface.geometric_normal_ws, 0, radius)) return 1;
        constexpr std::uint32_t first_number = 16;  // behind those of the estimate
        return passes::open_part(bvh_, surface.position_ws, surface.geometric_normal_ws, 2 * radius,
                                 passes::PathSampler(key, 0), first_number);
    }

    const passes::Bvh& bvh_;
    const passes::SurfaceLookup& surfaces_;
    SourceIrradiance sources_;
    std::uint64_t seed_;
    int samples_;
    float light_offset_;
    bool lights_backs_;
};

}  // namespace

std::optional<graph::BufferRef> sample_sources(graph::GraphBuilder& builder, const Surfels& surfels,
                                               const Parameters& parameters) {
    if (!has_sources(builder.inputs(), parameters)) return {};
    const auto room = builder.buffers().at(static_cast<std::size_t>(surfels.records.index)).elements;
    const auto irradiance =
        growing(builder,
                {.text = {.key = "surfels.irradiance",
                          .label = "Irradiance of surfels",
                          .doc = "Of both sides, by sources with an extent.",
                          .unit = "W/m²"},
                 .fields = record_fields<SurfelLight>()},
                {.key = "surfels.sampled", .label = "Surfels whose light is sampled"}, room);
    const auto bvh = passes::bvh(builder);
    const auto sources = sources_of(builder, parameters);
    builder.pass("light samples of surfels", graph::Queue::cpu)
        .reads(bvh, sources, surfels.records, surfels.stored)
        .writes(irradiance.buffer)
        .counts(irradiance.count)
        .execute_sliced(
            packing_parts,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& inputs = context.inputs();
                const auto traced = context.object<passes::Bvh>(bvh);
                const auto emitters = context.object<passes::ExtendedEmitters>(sources);
                const SurfelIrradiance estimate(*traced, *emitters, random_seed(inputs, parameters),
                                                parameters);
                const auto all = context.elements<const Surfel>(surfels.records);
                const auto lights = context.elements<SurfelLight>(irradiance.buffer);
                const auto counts = context.elements<const StoredSurfels>(surfels.stored);
                if (slice.first) context.add(irradiance.count, counts[0].made);
                const auto count =
                    static_cast<std::int64_t>(std::min<std::size_t>(counts[0].stored, lights.size()));
                parallel_for(inputs.threads, count * slice.begin / packing_parts,
                             count * slice.end / packing_parts, [&](std::int64_t i) {
                                 const auto at = static_cast<std::size_t>(i);
                                 lights[at] = estimate.of(all[at]);
                             });
                context.cancel().check();
            },
            1);
    return irradiance.buffer;
}

namespace {

/// Both sides of a surfel, whose irradiance by sources with an extent is given.
SurfelLight shaded(const HostSenders& senders, const Surfel& surfel, const SurfelLight& irradiance) {
    auto place = senders.place(surfel.triangle, glm::unpackUnorm2x16(surfel.barycentrics), surfel.centre_ws,
                               surfel.radius, -surfel.normal_ws);
    const auto of = [](const auto& side) { return glm::vec3(side[0], side[1], side[2]); };
    const auto front = senders.diffuse(place, of(irradiance.front));
    place.surface.geometric_normal_ws = -place.surface.geometric_normal_ws;
    place.surface.shading_normal_ws = -place.surface.shading_normal_ws;
    const auto back = senders.diffuse(place, of(irradiance.back));
    return {{front.x, front.y, front.z}, {back.x, back.y, back.z}};
}

}  // namespace

void shade_on_host(graph::GraphBuilder& builder, const passes::ShadowMaps& shadow, const Surfels& surfels,
                   const std::optional<graph::BufferRef>& irradiance, const Growing& lights,
                   const Parameters& parameters) {
    const auto surfaces = passes::host_surfaces(builder, parameters.transport.normal_maps);
    auto pass = builder.pass("shade surfels", graph::Queue::cpu);
    pass.has_two_bodies()
        .reads(surfaces, shadow.maps, shadow.panes, surfels.records, surfels.stored)
        .writes(lights.buffer)
        .counts(lights.count);
    if (irradiance) pass.reads(*irradiance);
    pass.execute_sliced(
        packing_parts,
        [=](graph::PassContext& context, graph::Slice slice) {
            const HostSenders senders(context, surfaces, shadow, parameters);
            const auto records = context.elements<const Surfel>(surfels.records);
            const auto results = context.elements<SurfelLight>(lights.buffer);
            const auto given = irradiance ? context.elements<const SurfelLight>(*irradiance)
                                          : std::span<const SurfelLight>();
            const auto counts = context.elements<const StoredSurfels>(surfels.stored)[0];
            if (slice.first) context.add(lights.count, counts.made);
            const auto count =
                static_cast<std::int64_t>(std::min<std::size_t>(counts.stored, results.size()));
            parallel_for(context.inputs().threads, count * slice.begin / packing_parts,
                         count * slice.end / packing_parts, [&](std::int64_t i) {
                             const auto at = static_cast<std::size_t>(i);
                             results[at] =
                                 shaded(senders, records[at], given.empty() ? SurfelLight{} : given[at]);
                         });
        },
        1);
}

}  // namespace ir::methods::deep_screen_space
