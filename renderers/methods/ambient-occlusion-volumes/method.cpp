// Ambient occlusion volumes: of each triangle the region that it can occlude is drawn over the picture, and
// each fragment decides exactly. All triangles add up [McGuire10], or the nearest along each sample's
// direction wins [Nalbach15 Fig. 2].
#include "renderers/graph/method.h"

#include "renderers/methods/ambient-occlusion-volumes/volumes.h"
#include "renderers/passes/direct/lit.h"

namespace ir::methods::ambient_occlusion_volumes {
namespace {

MethodDescription description() {
    const Condition bounced{"visibility", {true}};
    MethodDescription d;
    d.id = "ambient-occlusion-volumes";
    d.title = "Ambient occlusion volumes";
    d.summary =
        "Extrudes every triangle by the maximum distance into a volume and draws it over the picture; each "
        "pixel in it decides exactly how the triangle occludes its point, seen by the camera or not. With "
        "visibility, samples of a pixel keep the nearest triangle along directions of their own: exact rays, "
        "found by a depth test, or traced where the processor is the host. Without, form factors of all "
        "triangles add up and occlude too much where things lie behind each other; the host goes through "
        "them by tiles of the picture. The time grows with the number of volumes that cover a pixel: with "
        "triangles and with the cube of the maximum distance. Fall-off: with visibility as everywhere; "
        "without, smooth is the published product of distances to the volume's planes, and a triangle that "
        "occludes counts as a whole.";
    d.version = 2;
    d.papers = {"McGuire10", "Nalbach15"};
    d.background = 1;
    d.missing_light = passes::missing_in_lit();
    d.outputs = joined({{accessibility_output(), passes::lit_output(), passes::valid_output()},
                        additive_outputs(),
                        bounced_outputs(),
                        passes::bounce::direction_outputs(bounced),
                        passes::bounce::sample_outputs(bounced),
                        count_outputs(),
                        explanation_outputs(),
                        passes::bounce::reconstruction_outputs(bounced),
                        passes::direct_outputs()});
    d.selectors = {{.key = "sample",
                    .label = "Sample",
                    .doc = "One of the pixel's directions, with visibility.",
                    .parameter = "samples"}};
    d.stages = {{"bounce.incoming", 0, "First sample", bounced},
                {"volumes.raw", 0, "Before the blur", {"visibility", {false}}},
                {"accessibility", 0, "Result"}};
    return d;
}

graph::ImageRef with_visibility(graph::GraphBuilder& builder, const Volumes& volumes,
                                const Parameters& parameters, const graph::ResourceText& text) {
    namespace bounce = passes::bounce;
    const auto& gbuffer = volumes.gbuffer;
    const auto directions =
        bounce::directions(builder, volumes.scene, gbuffer, {.parameters = parameters.directions});
    const auto nearest = find_nearest(builder, volumes, directions);
    bounce::Batches all(directions.samples);
    const bounce::Samples samples{nearest.distance,
                                  bounce::declare_incoming(builder, all, bounce::Effects::ambient_occlusion)};
    bounce::fill_visibility(builder, gbuffer, directions, samples, parameters.transport);
    explain(builder, volumes, &directions, &nearest);
    return bounce::reconstruct(builder, volumes.scene, gbuffer, directions, samples,
                               parameters.reconstruction, text, volumes.reach);
}

graph::ImageRef without_visibility(graph::GraphBuilder& builder, const Volumes& volumes,
                                   const Parameters& parameters, const graph::ResourceText& text) {
    const auto raw = add_up(builder, volumes, parameters.transport.falloff);
    explain(builder, volumes, nullptr, nullptr);
    return passes::blur(builder, volumes.gbuffer, raw, parameters.reconstruction.blur, text);
}

void setup(graph::GraphBuilder& builder, const Parameters& parameters) {
    const auto scene = passes::upload_scene(builder);
    const auto gbuffer = passes::gbuffer(builder, scene, passes::gbuffer_options(parameters.transport));
    const auto direct = passes::direct_light(builder, scene, gbuffer, passes::lit_options(parameters.light));
    const auto volumes = declare_volumes(builder, scene, gbuffer, parameters);
    const auto text = builder.text_of_output("accessibility");
    const auto accessibility = parameters.visibility ? with_visibility(builder, volumes, parameters, text)
                                                     : without_visibility(builder, volumes, parameters, text);
    count_volumes(builder, volumes);
    passes::lit(builder, gbuffer, direct, accessibility, parameters.ambient);
    const bool has_volumes = !parameters.visibility || builder.inputs().processor == Processor::gl;
    if (parameters.transport.max_distance == 0 && has_volumes)
        builder.note(
            "ambient-occlusion-volumes: max_distance is 0, so every volume is as large as the scene and "
            "covers most of the picture; give a distance.");
}

}  // namespace

const graph::Method& method() {
    static const auto method =
        graph::make_method<Parameters>(description(), parameter_table(), setup, benchmarks());
    return method;
}

}  // namespace ir::methods::ambient_occlusion_volumes
