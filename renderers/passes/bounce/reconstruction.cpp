#include "renderers/passes/bounce/reconstruction.h"

#include <algorithm>

#include "renderers/passes/bounce/filter.h"
#include "renderers/passes/bounce/host/reconstruct_on_host.h"

namespace ir::passes::bounce {
namespace {

/// llvmpipe stops at 65,535 turns of a shader's loops, the last look at an inner loop's end counted: of
/// weights.comp with 16 samples 62,658 for (2 · 29 + 1)² neighbours.
constexpr int max_radius = 29;
static_assert((2 * max_radius + 1) * (2 * max_radius + 1) * (max_samples + 2) < 65535);

/// Constants of reconstruct.comp.
struct Reconstruct {
    FilterConstants filter;
    int first_layer;
    IR_FIELDS(filter, first_layer)
};

void reconstruct_on_device(graph::GraphBuilder& builder, const Filter& filter, const SampleGroup& group,
                           const std::string& name, const Reconstruction& r) {
    auto pass = builder.pass(name);
    pass.has_two_bodies();
    filter.declare_reads(pass);
    if (group.ends) {
        if (!group.begins) pass.reads("carried", r.sums);
        pass.writes("result", r.result);
    } else {
        pass.writes("sums", r.sums);
    }
    gl::ProgramSource source{{"passes/bounce/reconstruct.comp"}};
    filter.define(source);
    source.defines["BEGINS"] = group.begins ? "1" : "0";
    source.defines["ENDS"] = group.ends ? "1" : "0";
    Reconstruct constants{filter.constants(builder.inputs()), group.first_layer};
    constants.filter.samples = group.samples;
    compute_by_tiles(pass, builder, source, constants);
}

/// Constants of kernels.comp.
struct Kernels {
    FilterConstants filter;
    PixelRays rays;
    float kernel_by_distance;
    IR_FIELDS(filter, rays, kernel_by_distance)
};

/// By the first group of samples.
void choose_kernels(graph::GraphBuilder& builder, const Reconstruction& r) {
    auto filter = filter_of(r);
    filter.kernels = {};
    auto pass = builder.pass("kernels");
    pass.reads(r.gbuffer.position, r.gbuffer.normal, r.gbuffer.geometric_normal)
        .reads("distances", r.samples.distance)
        .writes("kernel_image", r.kernels);
    if (filter.receivers.options.light)
        pass.reads(r.gbuffer.material).may_read(r.gbuffer.albedo, r.scene.materials);
    gl::ProgramSource source{{"passes/bounce/kernels.comp"}};
    filter.define(source);
    Kernels constants{filter.constants(builder.inputs()), pixel_rays(builder.inputs().view),
                      r.parameters.kernel_by_distance};
    constants.filter.samples = std::min(group_samples, r.all_samples);
    compute_by_tiles(pass, builder, source, constants);
}

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
    table.add(&P::kernel_by_distance,
              {.key = "kernel_by_distance",
               .label = "Kernel by distance",
               .doc = "A pixel's kernel reaches at most this many times the distance at which rays about it "
                      "met something (harmonic mean), so that a wide blur keeps the shadows of what is "
                      "near. 0: all kernels are as wide as the blur's radius says.",
               .citation = "Nalbach15 §6",
               .hard = {0, 1e3},
               .soft = {0, 4},
               .active_when = active_when});
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

Reconstruction declare_reconstruction(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                      const GBuffer& gbuffer, const Directions& directions,
                                      const Samples& samples, const ReconstructionParameters& parameters,
                                      const Batches& batches, graph::ResourceText text) {
    Reconstruction r{scene, gbuffer, directions, samples, parameters, batches.samples()};
    r.result = builder.image({.text = std::move(text),
                              .format = directions.options.light ? gl::Format::rgba32f : gl::Format::r32f});
    if (parameters.kernel_by_distance > 0 && parameters.blur.used_radius() > 0)
        r.kernels = builder.image({.text = {.key = "bounce.kernels",
                                            .label = "Kernels",
                                            .doc = "Radius of each pixel's kernel.",
                                            .unit = "px"},
                                   .format = gl::Format::r32f});
    if (r.all_samples > group_samples)
        r.sums = builder.image({.text = {.key = "bounce.sums",
                                         .label = "Sums of the reconstruction",
                                         .doc = "RGB: of weighted values. A: of weights."}});
    return r;
}

void reconstruct(graph::GraphBuilder& builder, const Reconstruction& r, const Batch& batch) {
    if (r.kernels.index >= 0 && batch.first == 0) choose_kernels(builder, r);
    const auto filter = filter_of(r);
    for (int first = 0; first < batch.samples; first += group_samples) {
        const int count = std::min(group_samples, batch.samples - first);
        const SampleGroup group{first, count, batch.first + first == 0,
                                batch.first + first + count == r.all_samples};
        std::string name = "reconstruction";
        if (r.sums.index >= 0)
            name += " " + std::to_string((batch.first + first) / group_samples + 1) + " of " +
                    std::to_string((r.all_samples + group_samples - 1) / group_samples);
        if (builder.inputs().processor == Processor::host)
            reconstruct_on_host(builder, filter, group, name, r);
        else
            reconstruct_on_device(builder, filter, group, name, r);
    }
}

graph::ImageRef reconstruct(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                            const Directions& directions, const Samples& samples,
                            const ReconstructionParameters& parameters, graph::ResourceText text,
                            float miss_length) {
    const Batches batches(directions.samples);
    const auto& all = batches.all().front();
    const auto r = declare_reconstruction(builder, scene, gbuffer, directions, samples, parameters, batches,
                                          std::move(text));
    reconstruct(builder, r, all);
    const auto explanation = declare_ray_explanation(builder, r, miss_length);
    explain_rays(builder, explanation, all);
    share_rays(builder, explanation);
    show_weights(builder, r);
    return r.result;
}

}  // namespace ir::passes::bounce
