// Deep screen space: the scene becomes a cloud of surfels, each of which is splatted onto the pixels about
// it, on coarser levels of the picture the farther away. With visibility every sample of a pixel looks
// along one direction and keeps the nearest surfel. [Nalbach15; Nalbach14]
#include <algorithm>
#include <iomanip>
#include <map>
#include <optional>
#include <sstream>

#include "renderers/graph/method.h"

#include "renderers/methods/deep-screen-space/benchmark.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/methods/deep-screen-space/splatting/additive.h"
#include "renderers/methods/deep-screen-space/splatting/explain.h"
#include "renderers/passes/direct/compose.h"
#include "renderers/passes/direct/lit.h"
#include "renderers/passes/gbuffer/glass.h"

namespace ir::methods::deep_screen_space {
namespace {

using Paths = Transport::Paths;
namespace bounce = passes::bounce;

const Condition with_visibility{"visibility", {true}};

std::vector<OutputDescription> pictures() {
    auto radiance = passes::radiance_output(only_indirect);
    auto lit = passes::lit_output();
    lit.active_when = only_ao;
    auto accessibility = accessibility_output();
    accessibility.active_when = only_ao;
    return {accessibility,
            radiance,
            {.key = "indirect.radiance",
             .label = "Indirect radiance",
             .semantic = Semantic::radiance,
             .unit = "W/(m² sr)",
             .doc = "What the receiver reflects of the light that surfels send it, towards the eye.",
             .active_when = only_indirect},
            lit,
            passes::valid_output()};
}

std::vector<OutputDescription> outputs() {
    return joined({pictures(), bounce::direction_outputs(with_visibility),
                   bounce::sample_outputs(with_visibility), bounce::reconstruction_outputs(with_visibility),
                   passes::direct_outputs(), surfel_outputs(), hierarchy_outputs(), splat_outputs(),
                   visible_outputs(), additive_outputs(), explanation_outputs(),
                   passes::reprojection_outputs()});
}

MethodDescription description() {
    MethodDescription d;
    d.id = "deep-screen-space";
    d.title = "Deep screen space with bounced z-buffer";
    d.summary =
        "Turns what is near the view into surfels of equal size on the screen, splats each onto the pixels "
        "about it, and with visibility keeps, for each sample of a pixel, the nearest along its direction. "
        "Ambient occlusion, or one bounce of light with glossy receivers and senders. Surfaces that the "
        "picture does not show count. Errors come from the surfels' size, from the number of directions, and "
        "from far surfels that stand for many. Light passes glass straight on.";
    d.version = 8;
    d.papers = {"Nalbach15", "Nalbach14"};
    d.background = 1;
    d.missing_light = {passes::without_light_samples(),
                       {{LightPart::indirect},
                        {LightKind::lamp, LightKind::surface, LightKind::environment},
                        {{"sender_samples", {std::int64_t{0}}}}},
                       {{LightPart::direct}, {LightKind::environment}, {only_ao}}};  // of "lit"
    d.outputs = outputs();
    d.selectors = {surfel_selector()};
    d.stages = {{"bounce.incoming", 0, "What the first sample met", with_visibility},
                {"accessibility", 0, "Reconstructed", only_ao},
                {"indirect.radiance", 0, "Reconstructed", only_indirect},
                {"radiance", 0, "With direct light", only_indirect}};
    return d;
}

/// The picture that surfels make: accessibility or reflected radiance.
graph::ImageRef gather(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                       const Parameters& parameters, graph::ResourceText text) {
    const auto reach = reach_of(parameters, *builder.inputs().world);
    const auto surfels = make_surfels(builder, scene, shadow, reach.whole, parameters);
    const auto hierarchy = shuffle(builder, gbuffer, parameters);
    if (!parameters.visibility)
        return splat_additive(builder, scene, gbuffer, shadow, hierarchy, surfels, parameters,
                              std::move(text));
    bounce::Batches batches(builder, parameters.directions.samples);
    const auto visible =
        declare_visible(builder, scene, gbuffer, shadow, hierarchy, surfels, parameters, batches);
    const bool by_variance = filters_by_variance(parameters);
    auto weights = parameters.reconstruction;
    if (by_variance) weights.blur.blur = false;
    const auto reconstruction =
        bounce::declare_reconstruction(builder, scene, gbuffer, visible.directions, visible.samples, weights,
                                       batches, by_variance ? bounce::text_of_unfiltered(text) : text);
    std::optional<bounce::VarianceFilter> filter;
    if (by_variance) filter = bounce::declare_variance_filter(builder, reconstruction, parameters.filter);
    const int samples = batches.samples();
    const auto of_splats = declare_explanation(builder, visible, samples);
    const auto of_rays = bounce::declare_ray_explanation(builder, reconstruction);
    for (const auto& batch : batches.all()) {
        splat_visible(builder, visible, batch);
        bounce::reconstruct(builder, reconstruction, batch);
        if (filter) bounce::add_moments(builder, *filter, batch);
        explain_splats(builder, of_splats, visible, batch);
        bounce::explain_rays(builder, of_rays, batch);
        batches.keep(builder, batch);
    }
    judge_splats(builder, of_splats, visible, samples);
    bounce::share_rays(builder, of_rays);
    const auto all = whole(visible, batches);
    show_visible(builder, all);
    auto of_all = reconstruction;
    of_all.directions = all.directions;
    of_all.samples = all.samples;
    bounce::show_weights(builder, of_all);
    if (!filter) return reconstruction.result;
    return bounce::filter_samples(builder, *filter, parameters.reprojection, std::move(text));
}

std::string in_metres(float length) {
    std::ostringstream text;
    text << std::setprecision(3) << length << " m";
    return text.str();
}

void note_reach(graph::GraphBuilder& builder, const Parameters& parameters) {
    if (parameters.transport.max_distance > 0 || parameters.last_shell == LastShell::open) return;
    const auto reach = reach_of(parameters, *builder.inputs().world);
    builder.note("deep-screen-space: without a maximum distance surfels reach " + in_metres(reach.whole) +
                 ", the shell radius " + in_metres(reach.shell_radius) + " doubled " +
                 std::to_string(parameters.levels - 1) +
                 " times; what is farther sends and occludes nothing.");
}

void note_glass(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Parameters& parameters) {
    if (!has_open_glass(builder.inputs(), parameters))
        passes::note_opaque_glass(builder, gbuffer, "surfels");
    else if (has_closed_glass(builder.inputs()))
        passes::note_opaque_glass(builder, gbuffer,
                                  "surfels where a texture says its transmission or where it shines");
}

passes::DirectLightOptions direct_options(const Parameters& parameters) {
    if (parameters.transport.paths == Paths::ao) return passes::lit_options(parameters.light);
    return {.extended = passes::extended_light_options(parameters.light, parameters.transport)};
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto direct = passes::direct_light(builder, scene, gbuffer, direct_options(parameters));
    const bool ao = parameters.transport.paths == Paths::ao;
    const auto picture = passes::reproject(
        builder, gbuffer,
        [&](graph::ResourceText text) {
            return gather(builder, scene, gbuffer, direct.shadow, parameters, std::move(text));
        },
        filters_by_variance(parameters) ? passes::ReprojectionParameters{} : parameters.reprojection,
        builder.text_of_output(ao ? "accessibility" : "indirect.radiance"));
    if (ao)
        passes::lit(builder, gbuffer, direct, picture, parameters.ambient);
    else {
        passes::compose_light(builder, gbuffer, direct, picture, parameters.transport);
        note_glass(builder, gbuffer, parameters);
    }
    note_reach(builder, parameters);
}

/// Weights of neighbours, which the pass describes and whose defaults are this method's own since version 8.
void keep_older_weights(std::vector<ParameterDescription>& parameters) {
    const std::map<std::string, double> before{
        {"blur_plane_tolerance", 0.1}, {"blur_normal_power", 16}, {"balance", 0.1}};
    for (auto& parameter : parameters) {
        const auto older = before.find(parameter.key);
        if (older == before.end()) continue;
        parameter.since_version = 8;
        parameter.value_in_older_projects = older->second;
    }
}

}  // namespace

const graph::Method& method() {
    static const auto method = [] {
        auto made = graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
        keep_older_weights(made.description.parameters);
        return made;
    }();
    return method;
}

}  // namespace ir::methods::deep_screen_space
