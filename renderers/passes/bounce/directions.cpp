#include "renderers/passes/bounce/directions.h"

#include "renderers/passes/bounce/receiver.h"

namespace ir::passes::bounce {
namespace {

/// Constants of directions.comp.
struct ChooseDirections {
    ReceiverConstants receivers;
    unsigned seed_low, seed_high, frame, first_sample, samples;
    IR_FIELDS(receivers, seed_low, seed_high, frame, first_sample, samples)
};

/// Pixels of a side of the blocks that share a sequence, as a power of 2. Pixels whose frames are averaged
/// have one each.
constexpr int block_bits = 5;

gl::ProgramSource source_of(const Receivers& receivers) {
    gl::ProgramSource source{{"passes/bounce/directions.comp"}};
    receivers.define(source);
    const auto& parameters = receivers.options.parameters;
    source.defines["COSINE"] = parameters.distribution == Distribution::cosine ? "1" : "0";
    source.defines["STRATIFIED"] = parameters.spread == Spread::stratified ? "1" : "0";
    source.defines["BLOCK_BITS"] = std::to_string(receivers.options.vary ? 0 : block_bits);
    return source;
}

void add_choices(ParameterTable<DirectionParameters>& table, const Condition& active_when, Effects effects) {
    table
        .add(&DirectionParameters::samples,
             {.key = "samples",
              .label = "Samples",
              .doc = "Directions per pixel, each of which asks for the nearest surface along it.",
              .citation = "Nalbach15 §3.1",
              .hard = {1, max_samples},
              .soft = {1, max_samples},
              .active_when = active_when,
              .coarse = std::int64_t{1}})
        .add(&DirectionParameters::spread,
             {.key = "spread",
              .label = "Spread of samples",
              .doc = "How directions lie to each other. Each by itself is as likely as before.",
              .citation = "Kollig02",
              .choices = {{"stratified", "Stratified",
                           "Spread evenly over the hemisphere or the lobes: those of a pixel, and of pixels "
                           "next to each other together, or where frames are averaged of a pixel's frames. "
                           "Less noise."},
                          {"independent", "Independent", "Each drawn by itself, as published."}},
              .active_when = active_when})
        .add(
            &DirectionParameters::distribution,
            {.key = "distribution",
             .label = "Distribution of directions",
             .doc = "Where the rays of ambient occlusion go. Light is always sampled by BRDF times cosine.",
             .citation = "Nalbach15 §3.1",
             .choices = {{"uniform", "Uniform", "Density 1/2π over the hemisphere, as published."},
                         {"cosine", "Cosine",
                          "Density cosθ/π: no ray is spent where it counts little, so there is less noise."}},
             .active_when = effects == Effects::ambient_occlusion ? active_when : only_ao});
}

}  // namespace

ParameterTable<DirectionParameters> direction_parameters(const Condition& active_when, Effects effects) {
    ParameterTable<DirectionParameters> table;
    add_choices(table, active_when, effects);
    if (effects == Effects::ambient_occlusion) return table;
    table.add(
        &DirectionParameters::min_roughness,
        {.key = "min_roughness",
         .label = "Minimum roughness",
         .doc = "Smoother receivers reflect as if they were this rough. A mirror's one direction has no "
                "density, and what its neighbours met would be of no use to it.",
         .hard = {0.032, 1},
         .soft = {0.032, 0.5},
         .active_when = only_indirect});
    return table;
}

std::vector<OutputDescription> direction_outputs(const Condition& active_when) {
    return {{.key = "bounce.directions",
             .label = "Directions",
             .kind = OutputKind::stack,
             .semantic = Semantic::normal,
             .doc = "The direction buffer, a layer per sample: where the pixel's ray goes (RGB, unit, world "
                    "space) and with which density it was chosen (A, 1/sr). 0: no ray. Rays of ambient "
                    "occlusion that point below the triangle's plane count as closed.",
             .active_when = active_when}};
}

Directions declare_directions(graph::GraphBuilder& builder, Batches& batches,
                              const DirectionOptions& options) {
    return {batches.stack(builder, {.text = builder.text_of_output("bounce.directions")}), batches.together(),
            options};
}

void choose_directions(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                       const Directions& directions, const Batch& batch) {
    const auto& options = directions.options;
    const Receivers receivers{scene, gbuffer, options};
    auto pass = builder.pass("directions" + batch.name);
    receivers.declare_reads(pass);
    pass.writes("directions", directions.directions);
    const auto& inputs = builder.inputs();
    compute_by_tiles(pass, builder, source_of(receivers),
                     ChooseDirections{.receivers = receivers.constants(inputs),
                                      .seed_low = static_cast<unsigned>(inputs.seed),
                                      .seed_high = static_cast<unsigned>(inputs.seed >> 32),
                                      .frame = options.vary ? static_cast<unsigned>(inputs.frame) : 0u,
                                      .first_sample = static_cast<unsigned>(batch.first),
                                      .samples = static_cast<unsigned>(options.parameters.samples)});
}

Directions directions(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                      const DirectionOptions& options) {
    Batches batches(options.parameters.samples);
    const auto result = declare_directions(builder, batches, options);
    choose_directions(builder, scene, gbuffer, result, batches.all().front());
    return result;
}

}  // namespace ir::passes::bounce
