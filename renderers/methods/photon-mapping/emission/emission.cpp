#include "renderers/methods/photon-mapping/stages.h"

#include "renderers/core/error.h"
#include "renderers/methods/photon-mapping/emission/lab.h"
#include "renderers/methods/photon-mapping/emission/points.h"
#include "renderers/methods/photon-mapping/emission/traced.h"
#include "renderers/methods/photon-mapping/emission/views.h"
#include "renderers/methods/photon-mapping/emission/weights.h"
#include "renderers/passes/lights/shining.h"

namespace ir::methods::photon_mapping {
namespace {

constexpr int max_bounces = 8;  ///< bounces fit 4 bits of a photon's record, the pipeline is built for 8

void check(const Parameters& parameters) {
    if (parameters.transport.max_bounces > max_bounces)
        throw UsageError("max_bounces: photon-mapping traces at most " + std::to_string(max_bounces) +
                         " bounces, not " + std::to_string(parameters.transport.max_bounces));
    if (parameters.photon_far > 0 && parameters.photon_far < parameters.photon_near)
        throw UsageError("photon_far: nothing lies between the photon planes at " +
                         std::to_string(parameters.photon_near) + " m and " +
                         std::to_string(parameters.photon_far) + " m; raise photon_far or lower photon_near");
}

MappedEmission draw_maps(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                         const passes::GBuffer& gbuffer, const Sources& sources,
                         std::optional<TexelWeights>& weights, const Parameters& parameters) {
    MappedEmission mapped;
    mapped.rsm =
        passes::draw_rsm(builder, scene,
                         {.views = sources.views,
                          .resolution = texels(parameters.rsm_resolution),
                          .opaque_only = parameters.transport.materials == Transport::Materials::lambert,
                          .normal_maps = parameters.transport.normal_maps,
                          .depth_prepass = parameters.depth_prepass,
                          .geometric_normal = true,
                          .may_be_traced = true});
    if (parameters.has_weights())
        weights = declare_weights(builder, gbuffer, mapped.rsm.resolution, mapped.rsm.layers);
    mapped.maps = emission_maps(builder, scene, mapped.rsm, weights, parameters);
    return mapped;
}

}  // namespace

SamplePoints emit(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                  const passes::GBuffer& gbuffer, const Parameters& parameters) {
    check(parameters);
    const bool has_maps = parameters.first_hit == FirstHit::rsm;
    const auto sources = find_sources(builder.inputs(), parameters, texels(parameters.rsm_resolution));
    auto points = declare_points(builder, sources, parameters);
    passes::note_darkness(builder, parameters.transport);

    std::optional<MappedEmission> mapped;
    std::optional<TracedEmission> traced;
    if (has_maps) mapped = draw_maps(builder, scene, gbuffer, sources, points.samples.weights, parameters);
    if (sources.has_traced() || !has_maps)
        traced = trace_emission(builder, scene, sources, points, parameters);
    divide_points(builder, sources, points, mapped ? &mapped->maps : nullptr,
                  sources.has_traced() ? std::optional(traced->rows) : std::nullopt, parameters);
    if (mapped) warp_points(builder, scene, sources, *mapped, points, parameters);
    if (traced) survive_hits(builder, *traced, sources, points, parameters);
    find_places(builder, points);
    if (mapped) pack_points(builder, scene, sources, *mapped, points, parameters);
    if (traced) pack_hits(builder, *traced, sources, points, parameters);
    points.samples.all_points = static_cast<std::uint32_t>(points.count);
    points.samples.from_maps = static_cast<std::uint32_t>(points.from_maps);
    if (traced) points.samples.traced_rays = traced->rays.rays;
    if (mapped) {
        show_emission(builder, sources, mapped->maps, points, parameters);
        show_levels(builder, gbuffer, sources, *mapped, points, parameters);
    }
    return points.samples;
}

std::vector<OutputDescription> emission_outputs() {
    auto outputs = passes::rsm_outputs(from_rsm(), true);
    for (const auto& more :
         {probability_outputs(), weight_outputs(), point_outputs(), view_outputs(), level_outputs()})
        outputs.insert(outputs.end(), more.begin(), more.end());
    return outputs;
}

}  // namespace ir::methods::photon_mapping
