// Ambient occlusion and obscurance from layered depth maps: the scene is rasterised along N directions with
// all its layers, and the first hits along ±v from any point are the neighbours of the point's own depth in
// the map along v. [Aalund15 §3.3]
#include "renderers/graph/method.h"

#include "renderers/methods/ldm-ao/parameters.h"
#include "renderers/methods/ldm-ao/passes.h"
#include "renderers/passes/direct/lit.h"
#include "renderers/passes/ldm/coarse_scene.h"
#include "renderers/passes/ldm/map_views.h"

namespace ir::methods::ldm_ao {
namespace {

MethodDescription description() {
    MethodDescription d;
    d.id = "ldm-ao";
    d.title = "Ambient occlusion from layered depth maps";
    d.summary =
        "Rasterises the scene along many directions, keeps every layer, and reads the first hits of all rays "
        "in these directions from the sorted depths. Nothing is precomputed. Errors come from the number of "
        "directions and from the maps' texels.";
    d.papers = {"Aalund15", "Leopardi06", "Lefebvre14"};
    d.version = 2;
    d.background = 1;
    d.missing_light = passes::missing_in_lit({{"ambient_source", {std::string("constant")}}});
    d.selectors = {passes::ldm::map_selector_description()};
    d.outputs = joined(
        {{accessibility_output(),
          passes::lit_output(),
          passes::valid_output(),
          passes::ldm::sky_output({"ambient_source", {std::string("environment")}}),
          {.key = "ldm.self_hits",
           .label = "Own entry found",
           .semantic = Semantic::probability,
           .doc = "Fraction of the directions in which the point's own entry was found in the map."},
          {.key = "ldm.missing",
           .label = "Own entry missing",
           .semantic = Semantic::probability,
           .doc =
               "Fraction of the directions in which the point has no own entry, because its surface ends before "
               "the texel's centre."},
          {.key = "ldm.leaks",
           .label = "Possible leaks",
           .semantic = Semantic::probability,
           .doc =
               "Fraction of the directions in which an entry ahead of the tangent plane was taken for the point's "
               "own: where light may leak."},
          overlay_output()},
         passes::direct_outputs(),
         passes::ldm::map_outputs(),
         effect_outputs(),
         explanation_outputs()});
    return d;
}

/// Why outermost depths are not enough; empty: they are.
std::string needs_lists(const Parameters& parameters) {
    if (parameters.transport.max_distance > 0) return "a max_distance";
    if (parameters.maps.self_hit != passes::ldm::SelfHit::tangent_plane) return "self_hit=normal-offset";
    if (replaces_hits(parameters.exact)) return "exact hits";
    return {};
}

/// Which nodes the maps have: plain ones also where arrays stand for outermost depths.
passes::ldm::NodeKind nodes_of(const Parameters& parameters) {
    // Without a limit of distance only outermost depths count, which are seldom near.
    const bool queries_slopes = passes::ldm::may_keep_slopes(parameters.maps.storage) &&
                                parameters.transport.max_distance > 0 && !replaces_hits(parameters.exact) &&
                                parameters.maps.self_hit == passes::ldm::SelfHit::tangent_plane;
    return queries_slopes ? parameters.nodes : passes::ldm::NodeKind::plain;
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto direct = passes::direct_light(builder, scene, gbuffer, passes::lit_options(parameters.light));
    passes::ldm::Options options = parameters.maps;
    if (const auto reason = needs_lists(parameters);
        !reason.empty() && options.storage == passes::ldm::StorageKind::outermost) {
        builder.note("storage=outermost tells whether anything is hit, not where: arrays are used for " +
                     reason);
        options.storage = passes::ldm::StorageKind::arrays;
    }
    options.nodes = nodes_of(parameters);
    const auto& inputs = builder.inputs();
    if (parameters.progressive)
        options.rotation = passes::ldm::random_rotation(inputs.seed, inputs.frame);
    else if (parameters.orientation == Orientation::tilted)
        options.rotation = passes::ldm::tilt();
    const auto maps = passes::ldm::declare_maps(builder, options);
    const auto images = declare_images(builder, parameters);
    std::optional<ExactHits> exact;
    if (replaces_hits(parameters.exact)) exact = declare_exact_hits(builder, *maps, parameters);
    const auto chosen = passes::ldm::chosen_maps(inputs.inspection, *maps);
    const auto directions = passes::ldm::show_directions(builder, maps);
    const auto layers = passes::ldm::declare_layers(builder, *maps);
    const auto points = passes::ldm::declare_points(builder, *maps, chosen);
    const auto explanation = declare_explanation(builder, *maps, chosen);
    const auto effects = declare_effects(builder, *maps);
    const bool on_host = inputs.processor == Processor::host && has_host_body(parameters);
    std::optional<passes::ldm::Sky> sky;
    if (parameters.ambient_source == AmbientSource::environment)
        sky = passes::ldm::declare_sky(builder, maps, visibility_of(parameters.transport));
    if (on_host) trace_on_host(builder, gbuffer, maps, images, sky ? &*sky : nullptr, parameters);
    const auto of_maps = passes::ldm::map_scene(builder, scene, options.detail);
    // Beside the host's passes whole maps are built only while something looks at them.
    for (int batch = 0; batch < maps->layout.batches(); ++batch) {
        passes::ldm::build_maps(builder, of_maps, maps, batch);
        if (exact) trace_exact(builder, gbuffer, maps, batch, *exact, parameters.transport);
        if (!on_host) {
            trace(builder, gbuffer, maps, batch, images, exact ? &*exact : nullptr);
            trace_views(builder, gbuffer, maps, batch, images);
            if (sky) passes::ldm::trace_sky(builder, gbuffer, maps, batch, *sky, "methods/ldm-ao/sky.comp");
        }
        passes::ldm::show_layers(builder, maps, batch, chosen, layers);
        passes::ldm::find_points(builder, of_maps, maps, batch, points);
        explain(builder, gbuffer, maps, batch, directions, chosen, explanation);
        query_effects(builder, gbuffer, maps, batch, effects);
    }
    passes::ldm::show_sheets(builder, *maps, points);
    finish_effects(builder, gbuffer, maps, directions, effects);
    if (parameters.exact == Exact::selected)
        trace_selected(builder, gbuffer, maps, images, parameters.transport);
    resolve(builder, images, parameters);
    resolve_views(builder, gbuffer, images);
    if (sky) passes::ldm::finish_sky(builder, *sky, parameters.progressive);
    passes::lit(builder, gbuffer, direct, images.accessibility, parameters.ambient,
                sky ? std::optional(sky->light) : std::nullopt);
}

}  // namespace

const graph::Method& method() {
    static const auto method =
        graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
    return method;
}

}  // namespace ir::methods::ldm_ao
