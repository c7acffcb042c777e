// The path-traced reference: what every other method is judged by. Ambient occlusion and obscurance by
// cosine-weighted rays, and light by path tracing with next-event estimation, through Embree, and by light
// tracing where paths from the camera find it by chance or not at all; averaged over samples and frames.
#include "renderers/graph/method.h"

#include "renderers/methods/reference/join.h"
#include "renderers/methods/reference/parameters.h"
#include "renderers/methods/reference/passes.h"
#include "renderers/methods/reference/path_world.h"

namespace ir::methods::reference {
namespace {

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table
        .add(&Parameters::samples,
             {.key = "samples",
              .label = "Paths per pixel",
              .doc = "Traced in each frame; frames add up: after F frames a pixel is the mean of F times as "
                     "many. Raising it goes on from what is there.",
              .hard = {1, 1e6},
              .soft = {1, 1024},
              .on_change = OnChange::nothing,
              .accumulates = true,
              .coarse = std::int64_t{4}})
        .add(&Parameters::primary,
             {.key = "primary",
              .label = "First surface",
              .doc = "Where paths start.",
              .choices = {{"gbuffer", "G-buffer",
                           "At the rasterised surface in the pixel's centre, where the other methods start: "
                           "no antialiasing, and a difference image shows nothing but transport. Background "
                           "and glass are not valid; where there is glass, paths start with the ray through "
                           "the pixel's centre."},
                          {"rays", "Rays",
                           "Where rays that are uniform over the pixel (box filter) first meet something; "
                           "every pixel is valid."}}})
        .include(&Parameters::transport,
                 transport_parameters({.paths = {"ao", "direct", "indirect", "full"},
                                       .keys = {"min_bounces", "max_bounces", "max_distance", "falloff",
                                                "materials", "normal_maps", "environment_light", "emitters"},
                                       .emitters_since = 3}));
    return table;
}

void add_main_outputs(MethodDescription& d) {
    d.outputs.push_back(accessibility_output("; the mean of all samples so far."));
    d.outputs.back().active_when = only_ao;
    d.outputs.push_back({.key = "radiance",
                         .label = "Radiance",
                         .semantic = Semantic::radiance,
                         .unit = "W/(m² sr)",
                         .doc =
                             "Light towards the camera that the chosen paths bring; the mean of all samples "
                             "so far. Light over mirrors, through glass and over sharp surfaces is also "
                             "traced from its sources. That of point, spot and directional lights over "
                             "mirrors or through glass is missing where the camera sees it in a mirror or "
                             "through glass; a note says when a scene has such. Paths that meet more than 32 "
                             "mirrors or panes of glass are cut and counted as reference.cut_paths; samples "
                             "that are no finite number count as black, as reference.bad_samples, and a "
                             "warning says so.",
                         .active_when = only_light});
    d.outputs.push_back({.key = "direct",
                         .label = "Direct light",
                         .semantic = Semantic::radiance,
                         .unit = "W/(m² sr)",
                         .doc = "The part with one scattering, and unlit surfaces.",
                         .active_when = only_full});
    d.outputs.push_back({.key = "indirect",
                         .label = "Indirect light",
                         .semantic = Semantic::radiance,
                         .unit = "W/(m² sr)",
                         .doc = "The part with min_bounces + 1 to max_bounces + 1 scatterings. What remains "
                                "of the radiance is emission and background seen directly.",
                         .active_when = only_full});
}

void add_statistics(MethodDescription& d) {
    d.outputs.push_back({.key = "reference.variance",
                         .label = "Variance of the mean",
                         .doc = "Estimated variance of the main result as it stands, by channel, from 8 "
                                "independent randomisations (7 degrees of freedom); its square root is the "
                                "standard error of a pixel."});
    d.outputs.push_back({.key = "reference.samples",
                         .label = "Samples",
                         .semantic = Semantic::count,
                         .doc = "Paths per pixel so far."});
    for (const auto& output : {passes::position_output(), passes::normal_output(), passes::albedo_output(),
                               passes::valid_output()})
        d.outputs.push_back(output);
}

MethodDescription description() {
    MethodDescription d;
    d.id = "reference";
    d.title = "Path-traced reference";
    d.version = 4;
    d.summary =
        "Unbiased and slow: traces paths through Embree and adds up samples over frames. With a method's "
        "transport parameters it converges to what that method approximates. The picture comes with its own "
        "variance.";
    d.papers = {"Burley20", "Veach95", "Veach97", "Waechter19"};
    d.background = 1;
    d.is_reference = true;
    d.variance = "reference.variance";
    add_main_outputs(d);
    add_statistics(d);
    return d;
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    if (parameters.transport.paths == Transport::Paths::ao)
        return ambient_occlusion(builder, path_inputs(builder, parameters, {}), parameters);
    const auto materials = sharp_materials(*builder.inputs().scene, parameters.transport.materials);
    const auto inputs = path_inputs(builder, parameters, materials);
    note_limits(builder, parameters, materials);
    light_paths(builder, inputs, parameters, materials);
}

}  // namespace

const graph::Method& method() {
    static const auto method = [] {
        auto made = graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
        made.join = join;
        return made;
    }();
    return method;
}

}  // namespace ir::methods::reference
