// Real-time photon mapping: photons start where lights shine first, on points that are drawn from the
// reflective shadow maps by hierarchical warping, bounce through the scene, and are splatted as ellipsoids
// onto the G-buffer; a temporal and an edge-avoiding à-trous filter with clipped details take the noise away.
// [Smal19]
#include "renderers/graph/method.h"

#include "renderers/methods/photon-mapping/stages.h"

namespace ir::methods::photon_mapping {
namespace {

MethodDescription description() {
    MethodDescription d;
    d.id = "photon-mapping";
    d.title = "Real-time photon mapping";
    d.summary =
        "Draws photons from reflective shadow maps by importance and from lights with an extent, emissive "
        "meshes and the environment by power, traces them for some bounces, splats them "
        "as ellipsoids onto what the camera sees, and filters over time and space with details clipped by "
        "their variance. Nothing is precomputed. Errors come from noise (photons), from the kernels' width, "
        "from the filters, and from highlights that know a mean direction of the light alone.";
    d.version = 6;
    d.papers = {"Smal19", "Clarberg05", "Dammertz10", "Heitz18", "Knaus11"};
    d.missing_light = {passes::without_light_samples()};
    d.outputs = joined(
        {filtering_outputs(), splatting_outputs(), path_outputs(), tracing_outputs(), emission_outputs()});
    d.selectors = emission_selectors();
    for (const auto& selector : path_selectors()) d.selectors.push_back(selector);
    d.stages = filtering_stages();
    return d;
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto samples = emit(builder, scene, gbuffer, parameters);
    const auto photons = trace_photons(builder, scene, samples, parameters);
    learn_weights(builder, samples, parameters);
    const auto splat = splat_photons(builder, scene, gbuffer, photons, parameters);
    show_paths(builder, gbuffer, samples, photons, splat);
    const auto filtered = filter_irradiance(builder, gbuffer, splat, parameters);
    compose(builder, scene, gbuffer, filtered, parameters);
}

}  // namespace

const graph::Method& method() {
    static const auto method =
        graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
    return method;
}

}  // namespace ir::methods::photon_mapping
