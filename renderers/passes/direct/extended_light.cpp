#include "renderers/passes/direct/extended_light.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "renderers/core/half_float.h"
#include "renderers/core/limits.h"
#include "renderers/core/parallel_for.h"
#include "renderers/graph/declared.h"
#include "renderers/passes/a_trous/a_trous.h"
#include "renderers/passes/direct/device/sample_on_device.h"
#include "renderers/passes/direct/light_estimate.h"
#include "renderers/passes/direct/peeled_light.h"
#include "renderers/passes/direct/sampled_images.h"
#include "renderers/passes/gbuffer/gbuffer_surfaces.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/scene/stands_still.h"
#include "renderers/passes/surface/host_surfaces.h"
#include "renderers/passes/surface/host_texture.h"
#include "renderers/scene/light_sources.h"

namespace ir::passes {
namespace {

/// Pixels along a side of an item of work.
constexpr int light_tile = 16;
/// Of the filter: with fewer the noise of few samples stays.
constexpr int filter_passes = 4;

/// Those of a layer of depth peeling are never filtered.
SampledResults declare_sampled_results(graph::GraphBuilder& builder, int layer = 1) {
    const auto outputs = extended_light_outputs();
    const auto image = [&](std::size_t output, gl::Format format) {
        return builder.image({.text = of_layer(graph::text_of(outputs.at(output)), layer), .format = format});
    };
    SampledResults results{{}, image(1, gl::Format::rgba32f), image(2, gl::Format::r32f)};
    if (layer == 1) results.radiance = image(0, gl::Format::rgba32f);
    return results;
}

SampledImages declare_sampled_images(graph::GraphBuilder& builder, int layer = 1) {
    SampledImages images;
    const auto declare = [&](graph::ResourceText text, gl::Format format) {
        return builder.image({.text = of_layer(std::move(text), layer), .format = format});
    };
    images.sums =
        declare({.key = "direct.sums",
                 .label = "Sums of light samples",
                 .doc = "Over the frames in which nothing moved, of the means of groups of samples; A: of "
                        "their squared luminance.",
                 .semantic = Semantic::radiance,
                 .unit = "W/(m² sr)"},
                gl::Format::rgba32f);
    graph::BufferDesc progress;
    progress.text =
        of_layer({.key = "direct.progress",
                  .label = "Progress of light samples",
                  .doc = "How many groups of samples each pixel has, and the last frame that added some."},
                 layer);
    progress.fields = {{"groups", graph::FieldType::u32}, {"frame", graph::FieldType::u32}};
    progress.elements = 1;
    images.progress = builder.buffer(std::move(progress));
    images.results = declare_sampled_results(builder, layer);
    images.even = declare({.key = "direct.even",
                           .label = "Light without materials",
                           .doc = "What the filter starts from: divided by the reflectance; A: "
                                  "variance of the luminance."},
                          gl::Format::rgba32f);
    images.reflectance = declare({.key = "direct.reflectance",
                                  .label = "Reflectance",
                                  .doc = "What the filtered light is multiplied by.",
                                  .semantic = Semantic::albedo},
                                 gl::Format::rgba16f);
    return images;
}

/// Mean over the groups, and the variance of its luminance from their differences; of one group alone
/// the square.
struct SampledMean {
    glm::vec3 radiance;
    float variance;

    SampledMean(glm::vec4 sums, std::uint32_t groups) {
        const auto count = static_cast<float>(groups);
        radiance = glm::vec3(sums) / count;
        const float l = luminance(radiance);
        variance = groups > 1 ? std::max(sums.a / count - l * l, 0.0f) / (count - 1) : l * l;
    }
};

/// Samples a frame's pixels.
class LightSampling {
  public:
    LightSampling(const graph::PassContext& context, const GBuffer& gbuffer, const SampledImages& images,
                  graph::ObjectRef bvh, graph::ObjectRef sources, const ExtendedLightOptions& options,
                  bool is_peeled)
        : context_(context),
          is_peeled_(is_peeled),
          view_(context.inputs().view),
          viewer_(viewer(view_)),
          surfaces_(context, gbuffer),
          bvh_(context.object<Bvh>(bvh)),
          sources_(context.object<ExtendedEmitters>(sources)),
          estimate_(
              *bvh_, sources_->surfaces, sources_->lights,
              {.materials = options.materials, .between = options.materials, .mirrors = options.mirrors}),
          samples_(options.parameters.light_samples),
          groups_(std::min(samples_, max_groups)),
          progress_(context.elements<std::uint32_t>(images.progress)),
          sums_(context.pixels<glm::vec4>(images.sums)),
          unfiltered_(context.pixels<glm::vec4>(images.results.unfiltered)),
          even_(context.pixels<glm::vec4>(images.even)),
          variance_(context.pixels<float>(images.results.variance)),
          reflectance_(context.pixels<std::uint64_t>(images.reflectance)) {
        if (!continues(images)) return;
        groups_before_ = context.previous_contents<std::uint32_t>(images.progress)[0];
        sums_before_ = context.previous_contents<glm::vec4>(images.sums);
    }

    void run(graph::Slice slice) const {
        const int threads = context_.inputs().threads;
        parallel_for(threads, slice.begin, slice.end, [&](std::int64_t i) {
            if (!context_.cancel().is_cancelled()) fill_tile(static_cast<int>(i));
        });
        context_.cancel().check();
        if (!slice.last) return;
        progress_[0] = groups_before_ + static_cast<std::uint32_t>(groups_);
        progress_[1] = static_cast<std::uint32_t>(context_.inputs().frame);
    }

    static int tiles_across(int pixels) { return (pixels + light_tile - 1) / light_tile; }

  private:
    /// A frame in which nothing wanted the light leaves a gap.
    bool continues(const SampledImages& images) const {
        const auto& inputs = context_.inputs();
        return context_.has_previous() && stands_still(inputs, Watched::surfaces_and_lights) &&
               static_cast<std::int64_t>(context_.previous_contents<std::uint32_t>(images.progress)[1]) + 1 ==
                   inputs.frame;
    }

    struct Scratch {
        std::vector<PathSampler> samplers;
        std::vector<glm::vec3> radiances;
    };

    void fill_tile(int index) const {
        const int across = tiles_across(view_.width);
        const int left = index % across * light_tile, top = index / across * light_tile;
        Scratch scratch;
        for (int y = top; y < std::min(top + light_tile, view_.height); ++y)
            for (int x = left; x < std::min(left + light_tile, view_.width); ++x) fill(x, y, scratch);
    }

    void fill(int x, int y, Scratch& scratch) const {
        const auto i = static_cast<std::size_t>(y) * view_.width + x;
        auto sums = sums_before_.empty() ? glm::vec4(0) : sums_before_[i];
        auto reflectance = glm::vec3(0);
        if (!surfaces_.is_background(i)) {
            const auto surface = surfaces_.at(i);
            reflectance = estimate_.reflectance(surface);
            add_samples(surface, x, y, scratch, sums);
        }
        sums_[i] = sums;
        const SampledMean mean(sums, groups_before_ + static_cast<std::uint32_t>(groups_));
        unfiltered_[i] = glm::vec4(mean.radiance, 1);
        variance_[i] = mean.variance;
        const auto divisor = glm::max(reflectance, glm::vec3(min_reflectance));
        const float l = luminance(divisor);
        even_[i] = glm::vec4(mean.radiance / divisor, mean.variance / (l * l));
        reflectance_[i] = pack_halves(glm::vec4(divisor, 0));
    }

    int samples_of(int group) const { return (samples_ - group + groups_ - 1) / groups_; }

    /// Each frame and group has numbers of its own; within a group samples are stratified.
    void add_samples(const Surface& surface, int x, int y, Scratch& scratch, glm::vec4& sums) const {
        const auto& inputs = context_.inputs();
        const auto wo = is_peeled_ ? surface.geometric_normal_ws : viewer_.seen_from(surface.position_ws);
        const auto key = pixel_key(mixed(inputs.seed) + static_cast<std::uint64_t>(inputs.frame), x, y);
        scratch.samplers.clear();
        for (int group = 0; group < groups_; ++group)
            for (int i = 0; i < samples_of(group); ++i)
                scratch.samplers.emplace_back(key + static_cast<std::uint64_t>(group), i);
        scratch.radiances.resize(scratch.samplers.size());
        estimate_.sample(surface, wo, scratch.samplers, scratch.radiances);
        auto next = scratch.radiances.begin();
        for (int group = 0; group < groups_; ++group) {
            const int count = samples_of(group);
            const auto mean = std::accumulate(next, next + count, glm::vec3(0)) / static_cast<float>(count);
            const float l = luminance(mean);
            sums += glm::vec4(mean, l * l);
            next += count;
        }
    }

    const graph::PassContext& context_;
    bool is_peeled_;
    const scene::View& view_;
    Viewer viewer_;
    GBufferSurfaces surfaces_;
    std::shared_ptr<Bvh> bvh_;
    std::shared_ptr<ExtendedEmitters> sources_;
    LightEstimate estimate_;
    int samples_, groups_;
    std::uint32_t groups_before_ = 0;
    std::span<const glm::vec4> sums_before_;
    std::span<std::uint32_t> progress_;
    std::span<glm::vec4> sums_, unfiltered_, even_;
    std::span<float> variance_;
    std::span<std::uint64_t> reflectance_;
};

void sample_on_host(graph::GraphBuilder& builder, const GBuffer& gbuffer, const SampledImages& images,
                    const ExtendedLightOptions& options, int layer = 1) {
    const auto bvh = passes::bvh(builder);
    const auto sources = extended_emitters(builder, options);
    const auto& view = builder.inputs().view;
    auto pass = builder.pass(pass_of_layer("light samples", layer), graph::Queue::cpu);
    if (layer == 1) pass.has_two_bodies();
    pass.reads(bvh, sources)
        .reads_previous(images.sums, images.progress)
        .writes(images.sums, images.progress, images.results.unfiltered, images.results.variance, images.even,
                images.reflectance);
    GBufferSurfaces::declare_reads(pass, gbuffer);
    pass.execute_sliced(
        std::int64_t{1} * LightSampling::tiles_across(view.width) * LightSampling::tiles_across(view.height),
        [=](graph::PassContext& context, graph::Slice slice) {
            LightSampling(context, gbuffer, images, bvh, sources, options, layer > 1).run(slice);
        },
        2);
}

void note_wide_map(graph::GraphBuilder& builder) {
    const auto& map = *builder.inputs().scene->environment.map;
    builder.note("the environment map has " + std::to_string(map.width) + " x " + std::to_string(map.height) +
                 " texels, more than " + std::to_string(max_texture_side) +
                 " a side: its light is sampled on the host");
}

SampledImages sample_sources(graph::GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& gbuffer,
                             const ExtendedLightOptions& options) {
    const auto images = declare_sampled_images(builder);
    if (samples_on_device(builder.inputs(), options)) {
        sample_on_device(builder, scene, gbuffer, images, options);
        return images;
    }
    if (builder.inputs().processor == Processor::gl) note_wide_map(builder);
    sample_on_host(builder, gbuffer, images, options);
    return images;
}

graph::ImageRef filter_light(graph::GraphBuilder& builder, const GBuffer& gbuffer,
                             const SampledImages& images, const LightParameters& parameters) {
    a_trous::Options options;
    options.name = "light filter";
    options.passes = filter_passes;
    options.sigma_value = parameters.light_filter_strength;
    return a_trous::smooth(builder, a_trous::pack_surfaces(builder, gbuffer), {images.even},
                           {"direct.even_filtered", "Filtered light without materials"},
                           {"direct.filter", "Level of the light's filter", "Overwritten in turns."}, options)
        .value;
}

graph::ImageRef sample_and_filter(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                  const GBuffer& gbuffer, const ExtendedLightOptions& options) {
    const auto images = sample_sources(builder, scene, gbuffer, options);
    const auto result = images.results.radiance;
    gl::ProgramSource source{{"passes/direct/extended_light.comp"}};
    if (!options.parameters.light_filter) {
        builder.pass("extended light")
            .reads("unfiltered_image", images.results.unfiltered)
            .writes("result", result)
            .compute(source, result);
        return images.results.unfiltered;  // the same numbers, without the pass
    }
    source.defines["FILTERED"] = "1";
    const auto even = filter_light(builder, gbuffer, images, options.parameters);
    builder.pass("extended light")
        .reads("even_image", even)
        .reads("reflectance_image", images.reflectance)
        .writes("result", result)
        .compute(source, result);
    return result;
}

/// Nothing shines: what is listed is 0.
void no_extended_light(graph::GraphBuilder& builder) {
    const auto results = declare_sampled_results(builder);
    builder.pass("no extended light")
        .writes(results.radiance, results.unfiltered, results.variance)
        .execute([=](graph::PassContext& context) {
            for (const auto image : {results.radiance, results.unfiltered, results.variance})
                context.clear(image);
        });
}

std::string count_of(std::size_t count, const std::string& what) {
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

void note_left_out(graph::GraphBuilder& builder, const ExtendedSources& left_out) {
    std::vector<std::string> parts;
    if (left_out.flat_lights > 0) parts.push_back(count_of(left_out.flat_lights, "rectangle or disk light"));
    if (left_out.emissive_triangles > 0)
        parts.push_back(count_of(left_out.emissive_triangles, "emissive triangle"));
    if (left_out.environment) parts.emplace_back("the environment");
    std::string list;
    for (std::size_t i = 0; i < parts.size(); ++i)
        list += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i];
    builder.note("direct light leaves out " + list + ": light_samples is 0");
}

}  // namespace

bool samples_on_device(const graph::FrameInputs& inputs, const ExtendedLightOptions& options) {
    const auto& map = inputs.scene->environment.map;
    const bool is_wide = options.environment && map && std::max(map->width, map->height) > max_texture_side;
    return inputs.processor == Processor::gl && !is_wide;
}

ExtendedSources extended_sources(const graph::FrameInputs& inputs, const ExtendedLightOptions& options) {
    ExtendedSources found;
    for (const auto& light : inputs.world->lights) found.flat_lights += scene::is_flat(light);
    for (const auto& range : inputs.world->ranges)
        if (inputs.scene->materials.at(static_cast<std::size_t>(range.material)).emission != glm::vec3(0))
            found.emissive_triangles += range.triangle_count;
    const auto& environment = inputs.scene->environment;
    found.environment = options.environment && (environment.map || environment.constant != glm::vec3(0));
    return found;
}

graph::ObjectRef extended_emitters(graph::GraphBuilder& builder, const ExtendedLightOptions& options) {
    const std::string key = options.environment ? "direct.sources" : "direct.sources.placed";
    if (const auto found = graph::declared_object(builder, key)) return *found;
    auto fingerprint = builder.inputs().world_fingerprint;
    if (!fingerprint.empty() && options.environment) fingerprint += " environment";
    const auto textures = host_textures(builder);
    const auto result =
        builder.object({.text = {.key = key,
                                 .label = "Sources with an extent",
                                 .doc = "Lights, emissive triangles and the environment, with "
                                        "probabilities for choosing."},
                        .fingerprint = fingerprint});
    const LightSampler::Options sampled{.punctual = false, .environment = options.environment};
    builder.pass(options.environment ? "light sources" : "placed light sources", graph::Queue::cpu)
        .reads(textures)
        .writes(result)
        .execute([=](graph::PassContext& context) {
            const auto made = std::make_shared<ExtendedEmitters>(
                context.inputs(), sampled, context.object<std::vector<HostTexture>>(textures));
            context.store(result, made, made->surfaces.bytes());
        });
    return result;
}

std::vector<OutputDescription> extended_light_outputs() {
    return {
        {.key = "direct.extended",
         .label = "Light of sources with an extent",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = "The part of the direct light that comes from rectangles, disks, emissive meshes and the "
                "environment: the mean of all samples, filtered if asked for."},
        {.key = "direct.extended.unfiltered",
         .label = "The same, unfiltered",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = "The mean of all samples of the frames in which nothing moved."},
        {.key = "direct.extended.variance",
         .label = "Variance of the unfiltered light",
         .doc = "Estimated variance of that mean's luminance, from independent groups of samples, four in "
                "each frame; of a single sample its square."}};
}

std::optional<graph::ImageRef> extended_light(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                              const GBuffer& gbuffer, const ExtendedLightOptions& options) {
    const auto sources = extended_sources(builder.inputs(), options);
    if (sources.any() && options.parameters.light_samples > 0)
        return sample_and_filter(builder, scene, gbuffer, options);
    if (sources.any()) note_left_out(builder, sources);
    no_extended_light(builder);
    return {};
}

std::optional<graph::ImageRef> peeled_extended_light(graph::GraphBuilder& builder, const PeeledLayer& layer,
                                                     const ExtendedLightOptions& options) {
    if (!extended_sources(builder.inputs(), options).any() || options.parameters.light_samples == 0)
        return {};
    const auto images = declare_sampled_images(builder, layer.number);
    sample_on_host(builder, layer.surface, images, options, layer.number);
    return images.results.unfiltered;
}

}  // namespace ir::passes
