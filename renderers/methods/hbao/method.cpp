// Horizon-based ambient occlusion: for each pixel, horizons of the depth image in some directions around it.
// What no pixel shows occludes nothing, and what one shows is as thick as the scene. [Bavoil08]
#include "renderers/graph/method.h"

#include "renderers/methods/hbao/parameters.h"
#include "renderers/methods/hbao/passes.h"
#include "renderers/passes/direct/lit.h"

namespace ir::methods::hbao {
namespace {

MethodDescription description() {
    MethodDescription d;
    d.id = "hbao";
    d.title = "Horizon-based ambient occlusion";
    d.summary =
        "Marches the depth image in some directions around each pixel for the horizon, below which all is "
        "closed. Cheap and independent of the scene's size. What is hidden or beyond the picture's edge "
        "occludes nothing, and what is seen is taken to be infinitely thick. Fall-off: hard takes all that "
        "is nearer than the maximum distance for closed, smooth is the published attenuation 1 − d²/d_max². "
        "Without a maximum distance the march ends at the picture's edge, and all that it finds closes.";
    d.papers = {"Bavoil08", "Aalund15"};
    d.background = 1;
    d.missing_light = passes::missing_in_lit();
    d.selectors = {direction_selector()};
    d.outputs = joined({{accessibility_output("; with the published weighting openness by solid angle."),
                         passes::lit_output(), passes::valid_output()},
                        passes::direct_outputs(),
                        marched_outputs(),
                        explanation_outputs()});
    d.stages = {{"hbao.raw", 0, "Before the blur"}, {"accessibility", 0, "Blurred"}};
    return d;
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto direct = passes::direct_light(builder, scene, gbuffer, passes::lit_options(parameters.light));
    const auto marched = march(builder, gbuffer, parameters);
    const auto accessibility =
        passes::blur(builder, gbuffer, marched.raw, parameters.blur, builder.text_of_output("accessibility"));
    explain(builder, gbuffer, parameters);
    passes::lit(builder, gbuffer, direct, accessibility, parameters.ambient);
    if (parameters.transport.max_distance == 0)
        builder.note(
            "hbao: max_distance is 0, so marches end at the picture's edge and what lies beyond "
            "occludes nothing; “hbao.cut” shows where.");
    if (parameters.weighting == Weighting::published)
        builder.note(
            "hbao: weighting=published counts solid angles, not cosines; pictures of other methods "
            "and the reference show another quantity.");
}

}  // namespace

const graph::Method& method() {
    static const auto method =
        graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
    return method;
}

}  // namespace ir::methods::hbao
