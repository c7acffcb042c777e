#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <span>

#include "renderers/core/parallel_for.h"
#include "renderers/methods/deep-screen-space/surfels/host/host_senders.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "shaders/methods/deep-screen-space/surfels/stored.comp.h"

namespace ir::methods::deep_screen_space {
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
