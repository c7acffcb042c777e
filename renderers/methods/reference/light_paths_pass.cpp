#include "renderers/methods/reference/passes.h"

#include <tbb/enumerable_thread_specific.h>

#include <chrono>
#include <memory>

#include "renderers/methods/reference/estimate.h"
#include "renderers/methods/reference/light_tracing_pass.h"
#include "renderers/methods/reference/primary.h"
#include "renderers/methods/reference/tiles.h"

namespace ir::methods::reference {
namespace {

/// One item of work: some thousand paths, whose state fits into a core's cache.
constexpr std::uint64_t path_block = 8;

struct PathResources {
    PathInputs inputs;
    SharpMaterials materials;
    Progress progress;
    graph::ImageRef sums;                       ///< rgba32f stack, W/(m² sr)
    std::optional<graph::ImageRef> light_sums;  ///< what is traced from lights, to be added
    graph::ImageRef samples, radiance, variance;
    std::optional<graph::ImageRef> direct, indirect;
    std::shared_ptr<Tally> tally = std::make_shared<Tally>();
    bool has_parts() const { return direct.has_value(); }
    int layers() const { return has_parts() ? randomisations + 2 : randomisations; }
};

PathResources declare(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters) {
    PathResources r;
    r.inputs = inputs;
    r.progress = Progress(builder);
    r.radiance = builder.output("radiance", {.format = gl::Format::rgba32f});
    if (parameters.transport.paths == Transport::Paths::full) {
        r.direct = builder.output("direct", {.format = gl::Format::rgba32f});
        r.indirect = builder.output("indirect", {.format = gl::Format::rgba32f});
    }
    r.sums = builder.image(
        {.text = {.key = "reference.sums",
                  .label = "Sums",
                  .doc = "Sums of the samples over all frames: layers 1–8 by randomisation, then of direct "
                         "and indirect light apart.",
                  .semantic = Semantic::radiance,
                  .unit = "W/(m² sr)"},
         .format = gl::Format::rgba32f,
         .layers = r.layers()});
    r.variance = builder.output("reference.variance", {.format = gl::Format::rgba32f});
    r.samples = builder.output("reference.samples", {.format = gl::Format::r32ui});
    return r;
}

/// Traces slices of a frame's work.
class PathTracer {
  public:
    PathTracer(const graph::PassContext& context, const PathResources& r, const Parameters& parameters)
        : context_(context),
          resources_(r),
          tiles_(context.inputs(), path_block),
          samples_(r.progress.of_frame(context, static_cast<std::uint64_t>(parameters.samples))),
          bvh_(context.object<passes::Bvh>(r.inputs.bvh)),
          surfaces_(context.object<passes::SurfaceLookup>(r.inputs.surfaces)),
          lights_(context.object<passes::LightSampler>(r.inputs.lights)),
          indirect_lights_(context.object<passes::LightSampler>(r.inputs.indirect_lights)),
          world_(*bvh_, *surfaces_, {*lights_, *indirect_lights_}, r.materials),
          rules_(parameters.transport) {
        if (r.inputs.emission) {
            emission_ = context.object<passes::EmissionSampler>(*r.inputs.emission);
            shared_.emplace(context.inputs().view, *emission_, parameters.transport.materials,
                            shares_light(parameters));
        }
        if (r.inputs.gbuffer) gbuffer_.emplace(context, *r.inputs.gbuffer);
        for (int layer = 0; layer < r.layers(); ++layer)
            sums_.push_back(context.pixels<glm::vec4>(r.sums, layer));
    }

    void run(graph::Slice slice, std::int64_t declared) {
        const auto start = std::chrono::steady_clock::now();
        if (slice.first) start_sums(context_, resources_.sums, resources_.layers());
        run_tiles(context_, tiles_, samples_, slice, declared,
                  [&](std::int64_t tile, SampleRange range) { trace(tile, range); });
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        resources_.tally->milliseconds += spent.count();
    }

  private:
    /// What one thread works with.
    struct Bench {
        Bench(const scene::View& view, const PathWorld& world, const PathRules& rules,
              const passes::GBufferSurfaces* gbuffer, const SharedPaths* shared)
            : primary(view, gbuffer), wavefront(world, rules, {}, shared) {}
        PrimaryRays primary;
        Wavefront wavefront;
        std::vector<std::size_t> pixels;
        std::vector<PathStart> starts;
        std::vector<PathLight> lights;
    };

    Bench& bench() {
        auto& own = benches_.local();
        if (!own) {
            own = std::make_unique<Bench>(context_.inputs().view, world_, rules_,
                                          gbuffer_ ? &*gbuffer_ : nullptr, shared_ ? &*shared_ : nullptr);
        }
        return *own;
    }

    void trace(std::int64_t tile, SampleRange range) {
        auto& b = bench();
        b.pixels.clear(), b.starts.clear();
        b.primary.begin(std::size_t{Tiles::size} * Tiles::size);
        tiles_.for_each_pixel(tile, [&](int x, int y) {
            b.pixels.push_back(static_cast<std::size_t>(y) * context_.inputs().view.width + x);
            b.primary.add({x, y}, context_.inputs().seed, range.begin, range.end, b.starts);
        });
        b.lights.resize(b.starts.size());
        const auto before = b.wavefront.counts();
        b.wavefront.trace(b.starts, b.lights);
        add(b, range);
        auto& tally = *resources_.tally;
        tally.rays += b.wavefront.counts().rays - before.rays;
        tally.cut += b.wavefront.counts().cut - before.cut;
        tally.paths += b.starts.size();
    }

    /// Sample by sample in order; pixels belong to one tile, hence to one thread.
    void add(const Bench& b, SampleRange range) {
        auto light = b.lights.begin();
        for (const auto pixel : b.pixels) {
            for (auto sample = range.begin; sample < range.end; ++sample, ++light) {
                const auto sum = light->sum();
                if (!is_finite(sum)) {
                    ++resources_.tally->bad;
                    continue;
                }
                sums_[sample % randomisations][pixel] += glm::vec4(sum, 0);
                if (!resources_.has_parts()) continue;
                sums_[direct_layer][pixel] += glm::vec4(light->direct, 0);
                sums_[indirect_layer][pixel] += glm::vec4(light->indirect, 0);
            }
        }
    }

    const graph::PassContext& context_;
    const PathResources& resources_;
    Tiles tiles_;
    SampleRange samples_;
    std::shared_ptr<passes::Bvh> bvh_;
    std::shared_ptr<passes::SurfaceLookup> surfaces_;
    std::shared_ptr<passes::LightSampler> lights_, indirect_lights_;
    std::shared_ptr<passes::EmissionSampler> emission_;
    std::optional<SharedPaths> shared_;  ///< where light is traced from its sources, too
    PathWorld world_;
    PathRules rules_;
    std::optional<passes::GBufferSurfaces> gbuffer_;
    std::vector<std::span<glm::vec4>> sums_;
    tbb::enumerable_thread_specific<std::unique_ptr<Bench>> benches_;
};

/// The sums of paths from the camera and from lights together.
class LayerSums {
  public:
    LayerSums(const graph::PassContext& context, const PathResources& r) {
        for (int layer = 0; layer < r.layers(); ++layer) {
            camera_.push_back(context.pixels<glm::vec4>(r.sums, layer));
            if (r.light_sums) lights_.push_back(context.pixels<glm::vec4>(*r.light_sums, layer));
        }
    }
    glm::vec3 at(int layer, std::size_t pixel) const {
        const auto i = static_cast<std::size_t>(layer);
        const glm::vec3 sum(camera_[i][pixel]);
        return lights_.empty() ? sum : sum + glm::vec3(lights_[i][pixel]);
    }

  private:
    std::vector<std::span<glm::vec4>> camera_, lights_;
};

/// Mean and variance by channel. One sample alone says nothing: its variance is taken to be its square.
struct PixelEstimate {
    glm::vec3 mean{0};
    glm::vec4 variance{0};
};
PixelEstimate estimate_pixel(const LayerSums& sums, std::size_t pixel, std::uint64_t samples) {
    PixelEstimate result;
    for (int channel = 0; channel < 3; ++channel) {
        Sums s;
        for (int r = 0; r < randomisations; ++r) s[static_cast<std::size_t>(r)] = sums.at(r, pixel)[channel];
        const double first = s[0];
        const auto e = estimate(s, samples, first * first);
        result.mean[channel] = static_cast<float>(e.mean);
        result.variance[channel] = static_cast<float>(e.variance);
    }
    return result;
}

/// Pictures are looked at and saved with their alpha.
glm::vec4 opaque(glm::vec3 colour) {
    return {colour, 1};
}

void average(const graph::PassContext& context, const PathResources& r, const Parameters& parameters) {
    const auto per_frame = static_cast<std::uint64_t>(parameters.samples);
    const auto totals = r.progress.advance(context, per_frame, *r.tally);
    const Tiles tiles(context.inputs(), path_block);
    const auto samples = totals.samples;
    const LayerSums sums(context, r);
    const auto radiance = context.pixels<glm::vec4>(r.radiance);
    const auto variance = context.pixels<glm::vec4>(r.variance);
    const auto counts = context.pixels<std::uint32_t>(r.samples);
    const auto valid = context.pixels<std::uint8_t>(r.inputs.valid);
    const float share = 1 / static_cast<float>(samples);
    double sum_variance = 0, sum_valid = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto pixel = estimate_pixel(sums, i, samples);
        counts[i] = static_cast<std::uint32_t>(samples);
        radiance[i] = opaque(pixel.mean);
        variance[i] = pixel.variance;
        if (valid[i] == 0 || !tiles.has_pixel(i)) continue;
        sum_variance += pixel.variance.r + pixel.variance.g + pixel.variance.b;
        sum_valid += 3;
    }
    if (r.has_parts()) {
        const auto direct = context.pixels<glm::vec4>(*r.direct);
        const auto indirect = context.pixels<glm::vec4>(*r.indirect);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            direct[i] = opaque(share * sums.at(direct_layer, i));
            indirect[i] = opaque(share * sums.at(indirect_layer, i));
        }
    }
    report_figures(context, *r.tally, totals, sum_valid > 0 ? sum_variance / sum_valid : 0);
}

}  // namespace

void light_paths(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters,
                 const SharpMaterials& materials) {
    auto r = declare(builder, inputs, parameters);
    r.materials = materials;
    if (inputs.emission)
        r.light_sums = trace_light(builder, inputs, parameters, materials, r.progress, r.tally, r.layers());
    const auto declared =
        declared_items({builder.inputs(), path_block}, static_cast<std::uint64_t>(parameters.samples));
    auto trace = builder.pass("trace paths", graph::Queue::cpu);
    trace.reads(inputs.bvh, inputs.surfaces, inputs.lights, inputs.indirect_lights)
        .reads_previous(r.sums, r.progress.buffer())
        .writes(r.sums);
    if (inputs.emission) trace.reads(*inputs.emission);
    if (inputs.gbuffer) passes::GBufferSurfaces::declare_reads(trace, *inputs.gbuffer);
    trace.execute_sliced(
        declared,
        [=](graph::PassContext& context, graph::Slice slice) {
            PathTracer(context, r, parameters).run(slice, declared);
        },
        2);

    auto average_pass = builder.pass("average", graph::Queue::cpu);
    average_pass.reads(r.sums, inputs.valid)
        .reads_previous(r.progress.buffer())
        .writes(r.progress.buffer(), r.samples, r.radiance, r.variance);
    if (r.light_sums) average_pass.reads(*r.light_sums);
    if (r.has_parts()) average_pass.writes(*r.direct, *r.indirect);
    average_pass.execute([=](graph::PassContext& context) { average(context, r, parameters); });
}

}  // namespace ir::methods::reference
