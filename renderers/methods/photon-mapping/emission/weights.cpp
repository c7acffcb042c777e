#include "renderers/methods/photon-mapping/emission/weights.h"

namespace ir::methods::photon_mapping {
namespace {

/// Constants of weights.comp.
struct LearnWeights {
    float force, spring, drag, photons_per_point;
    IR_FIELDS(force, spring, drag, photons_per_point)
};

gl::ProgramSource source_of(const char* file, const Parameters& parameters) {
    gl::ProgramSource source{{file}};
    if (parameters.weights == Weights::printed) source.defines["PRINTED"] = "1";
    return source;
}

graph::ImageRef map_of(graph::GraphBuilder& builder, const char* key, int resolution, int layers) {
    return builder.output(key, {.format = gl::Format::r32f,
                                .extent = graph::Extent::fixed(resolution, resolution),
                                .layers = layers});
}

}  // namespace

TexelWeights declare_weights(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, int resolution,
                             int layers) {
    TexelWeights weights;
    weights.surfaces = gbuffer.position;
    weights.resolution = resolution;
    weights.layers = layers;
    graph::BufferDesc sums;
    sums.text = {.key = "emission.weights.sums",
                 .label = "Counts of texels",
                 .doc = "What the photons of this frame add to the count of the texel that they came from."};
    sums.fields = {{"sum", graph::FieldType::i32}};
    sums.elements = static_cast<std::uint64_t>(resolution) * static_cast<std::uint64_t>(resolution) *
                    static_cast<std::uint64_t>(layers);
    sums.cleared = true;
    weights.sums = builder.buffer(sums);
    weights.counts = map_of(builder, "emission.weights.counts", resolution, layers);
    weights.velocity = map_of(builder, "emission.weights.velocity", resolution, layers);
    weights.position = map_of(builder, "emission.weights.position", resolution, layers);
    return weights;
}

graph::ImageRef weigh(graph::GraphBuilder& builder, graph::ImageRef probability, const TexelWeights& weights,
                      const Parameters& parameters) {
    const auto weighted = map_of(builder, "emission.weighted", weights.resolution, weights.layers);
    builder.pass("weighted emission probability")
        .reads("probability", probability)
        .reads_previous("previous_position", weights.position)
        .writes("weighted", weighted)
        .compute(source_of("methods/photon-mapping/emission/weigh.comp", parameters), weighted);
    return weighted;
}

void learn_weights(graph::GraphBuilder& builder, const SamplePoints& samples, const Parameters& parameters) {
    if (!samples.weights) return;
    const auto& weights = *samples.weights;
    builder.pass("photon weights")
        .reads("Sources", samples.sources)
        .reads("Sums", weights.sums)
        .reads_previous("previous_velocity", weights.velocity)
        .reads_previous("previous_position", weights.position)
        .writes("counts", weights.counts)
        .writes("velocity", weights.velocity)
        .writes("position", weights.position)
        .compute(source_of("methods/photon-mapping/emission/weights.comp", parameters), weights.position,
                 LearnWeights{parameters.weight_force, parameters.weight_spring, parameters.weight_drag,
                              static_cast<float>(samples.photons_per_point)});
}

std::vector<OutputDescription> weight_outputs() {
    return {
        {.key = "emission.weighted",
         .label = "Weighted emission probability",
         .kind = OutputKind::stack,
         .semantic = Semantic::probability,
         .doc = "What photons follow: the emission probability times what the weight x of the frame before "
                "leaves of it, a tenth to all. Not normalised.",
         .active_when = when_weighted()},
        {.key = "emission.weights.counts",
         .label = "Counts of seen photons",
         .kind = OutputKind::stack,
         .doc = "m: over the photons that came from the texel in this frame, at each bounce, the gain where "
                "it is seen, -1 elsewhere and where it left the scene.",
         .active_when = when_weighted()},
        {.key = "emission.weights.velocity",
         .label = "Velocity of weights",
         .kind = OutputKind::stack,
         .unit = "1/frame",
         .doc = "v: by how much the weight moves in a frame. 0 towards the outside at 0 and 1.",
         .active_when = when_weighted()},
        {.key = "emission.weights.position",
         .label = "Weights",
         .kind = OutputKind::stack,
         .semantic = Semantic::probability,
         .doc = "x, which weighs the next frame's emission probability: 0 a tenth of it, 1 all.",
         .active_when = when_weighted()}};
}

}  // namespace ir::methods::photon_mapping
