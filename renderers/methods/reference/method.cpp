// The path-traced reference: what every other method is judged by. Ambient occlusion and obscurance on the
// rasterised G-buffer: cosine-weighted rays about the shading normal, traced through Embree, averaged over
// samples and frames.
#include "renderers/graph/method.h"

#include "renderers/methods/reference/ambient_occlusion_pass.h"
#include "renderers/methods/reference/parameters.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::methods::reference {
namespace {

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    table
        .add(&Parameters::samples,
             {.key = "samples",
              .label = "Paths per pixel",
              .doc = "Traced in each frame; frames add up: after F frames a pixel is the "
                     "mean of F times as many.",
              .hard = {1, 1e6},
              .soft = {1, 1024}})
        .add(&Parameters::primary,
             {.key = "primary",
              .label = "First surface",
              .doc = "Where paths start.",
              .choices = {{"gbuffer", "G-buffer",
                           "At the rasterised surface in the pixel's centre, where the other methods start: "
                           "no antialiasing, and a difference image shows nothing but transport."}}})
        .include(&Parameters::transport,
                 transport_parameters({.paths = {"ao"}, .keys = {"max_distance", "falloff", "normal_maps"}}));
    return table;
}

MethodDescription description() {
    MethodDescription d;
    d.id = "reference";
    d.title = "Path-traced reference";
    d.summary =
        "Unbiased and slow: traces rays through Embree and adds up samples over frames. With a method's "
        "transport parameters it converges to what that method approximates. The picture comes with its own "
        "variance.";
    d.papers = {"Burley20", "Waechter19"};
    d.background = 1;
    d.outputs = {
        {.key = "accessibility",
         .label = "Accessibility",
         .semantic = Semantic::accessibility,
         .doc = "Cosine-weighted openness of the hemisphere, 1 = open; the mean of all samples so far."},
        {.key = "reference.variance",
         .label = "Variance of the mean",
         .doc = "Estimated variance of the accessibility as it stands, from 8 independent randomisations "
                "(7 degrees of freedom); its square root is the standard error of a pixel."},
        {.key = "reference.samples",
         .label = "Samples",
         .semantic = Semantic::count,
         .doc = "Paths per pixel so far."},
        {.key = "valid", .label = "Valid", .semantic = Semantic::mask, .doc = "1 where the result counts."},
    };
    return d;
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, {.normal_maps = parameters.transport.normal_maps});
    ambient_occlusion(builder, gbuffer, passes::bvh(builder), parameters);
}

}  // namespace

const graph::Method& method() {
    static const auto instance = graph::make_method<Parameters>(description(), parameter_table(), setup);
    return instance;
}

}  // namespace ir::methods::reference
