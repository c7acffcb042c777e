#include "renderers/passes/bounce/sample_filter.h"

#include "renderers/passes/a_trous/a_trous.h"
#include "renderers/passes/bounce/filter.h"
#include "renderers/passes/direct/sampled_images.h"

namespace ir::passes::bounce {
namespace {

/// Pixels on either side whose samples tell a pixel's variance. [Schied17 §4.2]
constexpr int variance_radius = 3;
/// Of the filter; with five the last one's neighbours are 16 pixels apart. [Schied17 §4.3]
constexpr int filter_passes = 5;

/// Constants of moments.comp and uneven.comp.
struct Even {
    FilterConstants filter;
    float min_reflectance;
    IR_FIELDS(filter, min_reflectance)
};

gl::ProgramSource source_of(const Filter& filter, const char* file) {
    gl::ProgramSource source{{file}};
    filter.define(source);
    return source;
}

FilterConstants constants_of(const graph::GraphBuilder& builder, const Filter& filter, int samples) {
    auto constants = filter.constants(builder.inputs());
    constants.radius = variance_radius;
    constants.samples = samples;
    return constants;
}

/// What shows the surface of a pixel; programs use a part of it.
void may_read_receivers(graph::PassBuilder& pass, const Reconstruction& r) {
    pass.may_read(r.gbuffer.position, r.gbuffer.normal, r.gbuffer.geometric_normal);
    if (r.directions.options.light) pass.may_read(r.gbuffer.albedo, r.gbuffer.material, r.scene.materials);
}

/// RGB: means; A: variance of their luminance.
graph::ImageRef declare_even(graph::GraphBuilder& builder, const VarianceFilter& f,
                             graph::ResourceText text) {
    const auto even = builder.image({.text = std::move(text), .format = gl::Format::rgba32f});
    const auto filter = filter_of(f.of);
    auto pass = builder.pass("variance of samples");
    may_read_receivers(pass, f.of);
    pass.reads("moments", f.moments).writes("even_image", even);
    compute_by_tiles(pass, builder, source_of(filter, "passes/bounce/even.comp"),
                     constants_of(builder, filter, f.of.all_samples));
    return even;
}

}  // namespace

ParameterTable<SampleFilterParameters> sample_filter_parameters(const Condition& active_when) {
    using P = SampleFilterParameters;
    ParameterTable<P> table;
    table
        .add(&P::filter,
             {.key = "sample_filter",
              .label = "Filter of samples",
              .doc = "How a pixel takes part in its neighbours' samples.",
              .citation = "Schied17",
              .choices = {{"blur", "Blur",
                           "It gathers them by their distance and surface, and makes of each what its own "
                           "material does, as published."},
                          {"variance", "By variance, over frames",
                           "Its own samples are averaged over frames, where that is asked for, and then over "
                           "pixels by an edge-avoiding filter that lets them differ as far as the samples' "
                           "variance does not explain. Materials are divided out before it. The blur "
                           "gathers nothing then."}},
              .active_when = active_when,
              .since_version = 7,
              .value_in_older_projects = std::string("blur")})
        .add(&P::strength,
             {.key = "sample_filter_strength",
              .label = "Strength of that filter",
              .doc = "σ_l: neighbours whose luminance is so many standard errors away count 1/e.",
              .citation = "Schied17 eq. 5",
              .hard = {0.01, 1000},
              .soft = {0.5, 8},
              .active_when = {"sample_filter", {std::string("variance")}},
              .since_version = 7});
    return table;
}

graph::ResourceText text_of_unfiltered(graph::ResourceText text) {
    text.key = "bounce.unfiltered";
    text.label += ", unfiltered";
    text.doc = "What the pixels' own samples give.";
    return text;
}

VarianceFilter declare_variance_filter(graph::GraphBuilder& builder, const Reconstruction& reconstruction,
                                       const SampleFilterParameters& parameters) {
    return {
        reconstruction, parameters,
        builder.image({.text = {.key = "bounce.moments",
                                .label = "Sums of samples",
                                .doc = "Of each pixel's own, without the material. Light: RGB of values, A "
                                       "of squared luminances. Ambient occlusion: R of values, G of "
                                       "shares, A of squared values."},
                       .format = gl::Format::rgba32f})};
}

void add_moments(graph::GraphBuilder& builder, const VarianceFilter& f, const Batch& batch) {
    const auto filter = filter_of(f.of);
    auto pass = builder.pass("moments of samples" + batch.name);
    may_read_receivers(pass, f.of);
    pass.reads("directions", f.of.directions.directions)
        .reads("incoming", f.of.samples.incoming)
        .writes("moments", f.moments);
    auto source = source_of(filter, "passes/bounce/moments.comp");
    source.defines["BEGINS"] = batch.first == 0 ? "1" : "0";
    compute_by_tiles(pass, builder, source,
                     Even{constants_of(builder, filter, batch.samples), min_reflectance});
}

graph::ImageRef filter_samples(graph::GraphBuilder& builder, const VarianceFilter& f,
                               const ReprojectionParameters& reprojection, graph::ResourceText text) {
    const auto even = reproject(
        builder, f.of.gbuffer,
        [&](graph::ResourceText of_frame) { return declare_even(builder, f, of_frame); }, reprojection,
        {.key = "bounce.even",
         .label = "Samples without materials",
         .doc = "RGB: their mean, which the filter starts from. A: the variance of its luminance."},
        FourthChannel::variance);
    a_trous::Options options;
    options.name = "sample filter";
    options.passes = filter_passes;
    options.sigma_value = f.parameters.strength;
    const auto smooth =
        a_trous::smooth(builder, a_trous::pack_surfaces(builder, f.of.gbuffer), {even},
                        {"bounce.even_filtered", "Filtered samples without materials"},
                        {"bounce.filter", "Level of the samples' filter", "Overwritten in turns."}, options)
            .value;
    const bool light = f.of.directions.options.light;
    const auto result =
        builder.image({.text = std::move(text), .format = light ? gl::Format::rgba32f : gl::Format::r32f});
    const auto filter = filter_of(f.of);
    auto pass = builder.pass("filtered samples");
    may_read_receivers(pass, f.of);
    pass.reads("even_image", smooth).writes("result", result);
    compute_by_tiles(pass, builder, source_of(filter, "passes/bounce/uneven.comp"),
                     Even{constants_of(builder, filter, f.of.all_samples), min_reflectance});
    return result;
}

}  // namespace ir::passes::bounce
