#include "renderers/passes/bounce/reconstruction.h"

#include "renderers/passes/bounce/filter.h"
#include "renderers/passes/bounce/host/reconstruct_on_host.h"

namespace ir::passes::bounce {
namespace {

/// llvmpipe stops at 65,535 turns of a shader's loops, the last look at an inner loop's end counted: with 16
/// samples 62,658 for (2 · 29 + 1)² neighbours.
constexpr int max_radius = 29;
static_assert((2 * max_radius + 1) * (2 * max_radius + 1) * (max_samples + 2) < 65535);

}  // namespace

ParameterTable<ReconstructionParameters> reconstruction_parameters(const Condition& active_when,
                                                                   Effects effects) {
    using P = ReconstructionParameters;
    ParameterTable<P> table;
    table.add(&P::estimator,
              {.key = "estimator",
               .label = "Estimator",
               .doc = "How samples become accessibility. Light always takes the published one.",
               .citation = "Nalbach15 §3.3",
               .choices = {{"ratio", "Ratio",
                            "Divided by what all samples would give if all were open: an open plane is "
                            "exactly 1, whatever the directions."},
                           {"published", "Published",
                            "Divided by the samples' number. Right on average, also with few samples, but "
                            "even an open plane is noisy, and pixels may exceed 1."}},
               .active_when = effects == Effects::ambient_occlusion ? active_when : only_ao});
    table.include(&P::blur, blur_parameters(max_radius));
    if (effects == Effects::ambient_occlusion) return table;
    table
        .add(&P::material_tolerance,
             {.key = "material_tolerance",
              .label = "Blur across materials",
              .doc = "Difference of roughness or of metalness at which a neighbour's weight has fallen to "
                     "1/e: its directions are chosen for another BRDF. Base colours do not count, so that "
                     "textures do not add noise.",
              .citation = "Nalbach15 §3.3",
              .hard = {1e-3, 1e3},
              .soft = {0.01, 1},
              .active_when = only_indirect})
        .add(&P::balance,
             {.key = "balance",
              .label = "Balance",
              .doc = "Part that the pixel's own samples have beside those of each neighbour, by the balance "
                     "heuristic. 0: none, as published: a neighbour's sample is divided by its own density, "
                     "which makes bright dots where the pixel reflects what the neighbour seldom asks for. "
                     "Larger: more noise, and fewer dots.",
              .citation = "Veach97",
              .hard = {0, 0.5},
              .soft = {0, 0.5},
              .active_when = only_indirect,
              .since_version = 2,
              .value_in_older_projects = 0.0});
    return table;
}

graph::ImageRef reconstruct(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                            const Directions& directions, const Samples& samples,
                            const ReconstructionParameters& parameters, graph::ResourceText text) {
    const Filter filter{{scene, gbuffer, directions.options}, directions, samples, parameters};
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = directions.options.light ? gl::Format::rgba32f : gl::Format::r32f;
    const auto result = builder.image(std::move(desc));
    show_weights(builder, filter);
    if (builder.inputs().processor == Processor::host) {
        reconstruct_on_host(builder, filter, result);
        return result;
    }
    auto pass = builder.pass("reconstruction");
    pass.has_two_bodies();
    filter.declare_reads(pass);
    pass.writes("result", result);
    gl::ProgramSource source{{"passes/bounce/reconstruct.comp"}};
    filter.define(source);
    compute_by_tiles(pass, builder, source, filter.constants(builder.inputs()));
    return result;
}

}  // namespace ir::passes::bounce
