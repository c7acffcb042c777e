#include <algorithm>

#include "renderers/passes/bounce/filter.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::passes::bounce {
namespace {

using graph::FieldType;

const std::string fields =
    " hit: 1 where something was met; rays that met nothing are drawn as far as they were traced. "
    "distance: metres to it, negative without. density: with which the direction was chosen, 1/sr. incoming: "
    "openness, or the radiance that arrives, W/(m² sr). contribution: what the sample adds to the pixel, of "
    "both lists together the pixel. weight: of a sample beside those of the pixel itself. apart: pixels "
    "between the two.";
const std::string no_reconstruction = std::string(no_surface) + " that is reconstructed";

/// Struct Line of shaders/passes/bounce/explain.comp.
graph::CountedBuffer declare(graph::GraphBuilder& builder, const std::string& key, int channels,
                             int elements) {
    return builder.explanation(key, {.fields = {{"start", FieldType::f32, 3},
                                                {"end", FieldType::f32, 3},
                                                {"distance", FieldType::f32},
                                                {"density", FieldType::f32},
                                                {"incoming", FieldType::f32, channels},
                                                {"contribution", FieldType::f32, channels},
                                                {"weight", FieldType::f32},
                                                {"apart", FieldType::f32},
                                                {"hit", FieldType::u32},
                                                {"sample", FieldType::u32}},
                                     .elements = static_cast<std::uint64_t>(std::max(1, elements))});
}

/// Constants of explain.comp.
struct Explain {
    FilterConstants filter;
    glm::ivec2 picked;
    float miss_length;
    IR_FIELDS(filter, picked, miss_length)
};

float length_of_misses(const scene::World& world, float requested) {
    return requested > 0 ? requested : 0.2f * world.bounds.radius();
}

}  // namespace

std::vector<OutputDescription> reconstruction_outputs(const Condition& active_when) {
    return {
        {.key = "bounce.weights",
         .label = "Weights",
         .doc = "How samples share in a pixel. R: what the sum of their values is divided by; a sample of "
                "the pixel itself counts 1, with the ratio estimator as much as it gives if it is open. G: "
                "the largest part that one sample has in the value: near 1 where one makes a bright dot.",
         .active_when = active_when},
        {.key = "bounce.explain.rays",
         .label = "Rays of the pixel",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "The picked pixel's own samples, from its point to what they met." + fields,
         .when_empty = no_reconstruction,
         .explains = true,
         .active_when = active_when},
        {.key = "bounce.explain.neighbours",
         .label = "Rays of neighbours",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "The samples of other pixels that the reconstruction takes for the picked one, from their "
                "points to what they met." +
                fields,
         .when_empty = no_reconstruction,
         .explains = true,
         .active_when = active_when}};
}

void explain_rays(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                  const Directions& directions, const Samples& samples,
                  const ReconstructionParameters& parameters, float miss_length) {
    const Filter filter{{scene, gbuffer, directions.options}, directions, samples, parameters};
    const int side = 2 * parameters.blur.used_radius() + 1;
    const int channels = directions.options.light ? 3 : 1;
    const auto own = declare(builder, "bounce.explain.rays", channels, directions.samples),
               others = declare(builder, "bounce.explain.neighbours", channels,
                                (side * side - 1) * directions.samples);
    auto pass = builder.pass("explain rays");
    filter.declare_reads(pass);
    pass.reads("distances", samples.distance);
    pass.writes("OwnLines", own.elements).counts("OwnCount", own.count);
    pass.writes("OtherLines", others.elements).counts("OtherCount", others.count);
    const auto& inputs = builder.inputs();
    gl::ProgramSource source{{"passes/bounce/explain.comp"}};
    filter.define(source);
    pass.compute(source, 1,
                 Explain{filter.constants(inputs), inputs.picked_pixel(),
                         length_of_misses(*inputs.world, miss_length)});
}

void show_weights(graph::GraphBuilder& builder, const Filter& filter) {
    const auto weights = builder.output("bounce.weights", {.format = gl::Format::rg32f});
    auto pass = builder.pass("weights of samples");
    filter.declare_reads(pass);
    pass.writes("weights", weights);
    gl::ProgramSource source{{"passes/bounce/weights.comp"}};
    filter.define(source);
    source.defines["MAX_SAMPLES"] = std::to_string(max_samples);
    compute_by_tiles(pass, builder, source, filter.constants(builder.inputs()));
}

}  // namespace ir::passes::bounce
