#include "renderers/methods/ssdo/passes.h"

#include "renderers/core/record.h"
#include "shaders/methods/ssdo/explain.comp.h"

namespace ir::methods::ssdo {
namespace {

const Categories roles{"role",
                       {{0, "outside of the picture", tints::dark},
                        {1, "open", tints::sky},
                        {2, "an occluder that sends light", tints::yellow},
                        {3, "an occluder turned away", tints::vermilion},
                        {4, "an occluder below the pixel's horizon", tints::purple},
                        {5, "an occluder beyond the maximum distance", tints::grey}}};
const std::string sent =
    "sent: W/(m² sr), RGB, what the sample adds to the pixel's indirect light before the blur.";
const std::string sky =
    " sky: likewise of the environment's light, with environment_by=occlusion; with the density estimator by "
    "a step of another length along the same direction.";

/// Constants of explain.comp.
struct Explain {
    SampleConstants samples;
    glm::ivec2 picked;
    IR_FIELDS(samples, picked)
};

}  // namespace

std::vector<OutputDescription> explanation_outputs() {
    return {
        {.key = "ssdo.explain.samples",
         .label = "Samples",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "Where the picked pixel's steps end, and what became of them. step: its length, m. " + sent +
                sky,
         .categories = {roles},
         .when_empty = no_surface,
         .explains = true},
        {.key = "ssdo.explain.lines",
         .label = "Lines to the occluders",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "From the picked pixel's point to what occludes each sample, or along its step where nothing "
                "does, for each layer. pixel: where the sample ended in the picture, -1 outside. distance: "
                "m, from the pixel's point to the occluder, 0 without one. layer: 1 is what is seen. " +
                sent,
         .categories = {roles},
         .when_empty = no_surface,
         .explains = true},
    };
}

SelectorDescription sample_selector() {
    return {.key = "sample",
            .label = "Sample",
            .doc = "One of the directions over each pixel's hemisphere.",
            .parameter = "samples"};
}

void explain(graph::GraphBuilder& builder, const Inputs& inputs, graph::ImageRef senders) {
    const auto all = static_cast<std::uint64_t>(inputs.parameters.samples);
    const auto layers = static_cast<std::uint64_t>(inputs.parameters.layers);
    const auto samples = builder.explanation("ssdo.explain.samples",
                                             {.fields = record_fields<SampleEnd>(), .elements = all}),
               lines = builder.explanation("ssdo.explain.lines", {.fields = record_fields<LineToOccluder>(),
                                                                  .elements = all * layers});
    const auto& frame = builder.inputs();
    auto pass = builder.pass("explain");
    declare_reads(pass, inputs, senders);
    pass.writes("Ends", samples.elements).counts("EndCount", samples.count);
    pass.writes("Lines", lines.elements).counts("LineCount", lines.count);
    pass.compute(with_samples("methods/ssdo/explain.comp", inputs), 1,
                 Explain{sample_constants(frame, inputs), frame.picked_pixel()});
}

}  // namespace ir::methods::ssdo
