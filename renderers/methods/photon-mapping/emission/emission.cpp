#include "renderers/methods/photon-mapping/stages.h"

#include "renderers/core/error.h"
#include "renderers/methods/photon-mapping/emission/points.h"
#include "renderers/methods/photon-mapping/emission/traced.h"
#include "renderers/methods/photon-mapping/emission/views.h"

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

SamplePoints emit_from_rsm(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                           const Parameters& parameters) {
    const auto& inputs = builder.inputs();
    const auto sources = layers_of_lights(*inputs.scene, *inputs.world, texels(parameters.rsm_resolution));
    for (const auto& note : sources.notes()) builder.note(note);
    const auto rsm =
        passes::draw_rsm(builder, scene,
                         {.views = sources.views,
                          .resolution = texels(parameters.rsm_resolution),
                          .opaque_only = parameters.transport.materials == Transport::Materials::lambert,
                          .normal_maps = parameters.transport.normal_maps,
                          .depth_prepass = parameters.depth_prepass});
    const auto maps = emission_maps(builder, scene, rsm, parameters);
    auto points = declare_points(builder, sources, parameters);
    divide_points(builder, sources, points, &maps, parameters);
    find_points(builder, scene, sources, rsm, maps, points, parameters);
    show_emission(builder, sources, maps, points, parameters);
    return points.samples;
}

}  // namespace

SamplePoints emit(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                  const Parameters& parameters) {
    check(parameters);
    return parameters.first_hit == FirstHit::traced ? emit_traced(builder, scene, parameters)
                                                    : emit_from_rsm(builder, scene, parameters);
}

std::vector<OutputDescription> emission_outputs() {
    auto outputs = passes::rsm_outputs(from_rsm());
    for (const auto& more : {probability_outputs(), point_outputs(), view_outputs()})
        outputs.insert(outputs.end(), more.begin(), more.end());
    return outputs;
}

}  // namespace ir::methods::photon_mapping
