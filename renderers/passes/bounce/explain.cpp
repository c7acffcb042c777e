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

/// Struct Line of shaders/passes/bounce/ray_line.glsl.
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
    int first_sample;
    float miss_length;
    IR_FIELDS(filter, picked, first_sample, miss_length)
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
         .active_when = active_when},
        {.key = "bounce.explain.shares",
         .label = "Shares of rays",
         .kind = OutputKind::table,
         .doc = "The sum that the contributions of both lists of rays were divided by.",
         .when_empty = no_reconstruction,
         .explains = true,
         .active_when = active_when}};
}

RayExplanation declare_ray_explanation(graph::GraphBuilder& builder, const Reconstruction& r,
                                       float miss_length) {
    const int side = 2 * r.parameters.blur.used_radius() + 1;
    const int channels = r.directions.options.light ? 3 : 1;
    RayExplanation e{r, miss_length};
    e.own = declare(builder, "bounce.explain.rays", channels, r.all_samples);
    e.others = declare(builder, "bounce.explain.neighbours", channels, (side * side - 1) * r.all_samples);
    // An output, so that no other picked pixel finds it done.
    e.shares = builder.output("bounce.explain.shares",
                              {.fields = {{"shares", FieldType::f32}}, .elements = 1, .cleared = true});
    return e;
}

void explain_rays(graph::GraphBuilder& builder, const RayExplanation& e, const Batch& batch) {
    const auto filter = filter_of(e.of);
    auto pass = builder.pass("explain rays" + batch.name);
    filter.declare_reads(pass);
    pass.reads("distances", e.of.samples.distance);
    pass.writes("OwnLines", e.own.elements).counts("OwnCount", e.own.count);
    pass.writes("OtherLines", e.others.elements).counts("OtherCount", e.others.count);
    pass.writes("Shares", e.shares);
    const auto& inputs = builder.inputs();
    gl::ProgramSource source{{"passes/bounce/explain.comp"}};
    filter.define(source);
    Explain constants{filter.constants(inputs), inputs.picked_pixel(), batch.first,
                      length_of_misses(*inputs.world, e.miss_length)};
    constants.filter.samples = batch.samples;
    pass.compute(source, 1, constants);
}

void share_rays(graph::GraphBuilder& builder, const RayExplanation& e) {
    gl::ProgramSource source{{"passes/bounce/share_rays.comp"}};
    source.defines["LIGHT"] = e.of.directions.options.light ? "1" : "0";
    auto pass = builder.pass("shares of rays");
    pass.reads("Shares", e.shares)
        .writes("OwnLines", e.own.elements)
        .counts("OwnCount", e.own.count)
        .writes("OtherLines", e.others.elements)
        .counts("OtherCount", e.others.count)
        .compute(source, 1);
}

void show_weights(graph::GraphBuilder& builder, const Reconstruction& r) {
    const auto filter = filter_of(r);
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
