#include "renderers/methods/reference/light_tracing_pass.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "renderers/core/parallel_for.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/reference/light_tracer.h"
#include "renderers/methods/reference/tiles.h"

namespace ir::methods::reference {
namespace {

constexpr std::uint64_t paths_of_item = 1024;
constexpr std::int64_t items_together = 64;  ///< traced before their splats are added

struct LightTracing {
    PathInputs inputs;
    SharpMaterials materials;
    Progress progress;
    std::shared_ptr<Tally> tally;
    graph::ImageRef sums;
    int layers = 0;
};

std::int64_t items_of_sample(const scene::View& view) {
    const auto paths = static_cast<std::uint64_t>(view.width) * static_cast<std::uint64_t>(view.height);
    return static_cast<std::int64_t>((paths + paths_of_item - 1) / paths_of_item);
}

/// Samples are independent of each other and of the camera's; the paths of one are well distributed.
std::uint64_t key_of_sample(std::uint64_t seed, std::uint64_t sample) {
    constexpr std::uint64_t from_lights = 0x6c69676874;
    return passes::mixed(passes::mixed(passes::mixed(seed) ^ from_lights) ^ sample);
}

/// Traces slices of a frame's work. Splats are added in the order of samples and paths, whoever traced them.
/// A path may reach any pixel, so every shard of a picture traces all of them; the first counts them.
class SplatTracer {
  public:
    SplatTracer(const graph::PassContext& context, const LightTracing& r, const Parameters& parameters)
        : context_(context),
          resources_(r),
          samples_(r.progress.of_frame(context, static_cast<std::uint64_t>(parameters.samples))),
          bvh_(context.object<passes::Bvh>(r.inputs.bvh)),
          surfaces_(context.object<passes::SurfaceLookup>(r.inputs.surfaces)),
          lights_(context.object<passes::LightSampler>(r.inputs.lights)),
          indirect_lights_(context.object<passes::LightSampler>(r.inputs.indirect_lights)),
          emission_(context.object<passes::EmissionSampler>(*r.inputs.emission)),
          world_(*bvh_, *surfaces_, {*lights_, *indirect_lights_}, r.materials),
          shared_(context.inputs().view, *emission_, parameters.transport.materials,
                  shares_light(parameters)),
          tracer_(world_, PathRules(parameters.transport), shared_),
          counts_(context.inputs().shard.index == 1) {
        for (int layer = 0; layer < r.layers; ++layer)
            sums_.push_back(context.pixels<glm::vec4>(r.sums, layer));
    }

    void run(graph::Slice slice, std::int64_t declared) {
        const auto start = std::chrono::steady_clock::now();
        if (slice.first) start_sums(context_, resources_.sums, resources_.layers);
        const auto of_sample = items_of_sample(context_.inputs().view);
        const auto work =
            samples_.empty() ? 0 : static_cast<std::int64_t>(samples_.end - samples_.begin) * of_sample;
        const auto place = [&](std::int64_t item) {
            return static_cast<std::int64_t>(static_cast<double>(item) / static_cast<double>(declared) *
                                             static_cast<double>(work));
        };
        const auto last = slice.end == declared ? work : place(slice.end);
        for (auto item = place(slice.begin); item < last; item += items_together)
            trace(item, std::min(last, item + items_together), of_sample);
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        resources_.tally->milliseconds += spent.count();
    }

  private:
    void trace(std::int64_t begin, std::int64_t end, std::int64_t of_sample) {
        splats_.resize(static_cast<std::size_t>(end - begin));
        const int threads = context_.inputs().threads;
        parallel_for(threads, begin, end, [&](std::int64_t item) {
            auto& splats = splats_[static_cast<std::size_t>(item - begin)];
            splats.clear();
            if (!context_.cancel().is_cancelled())
                trace_item(samples_.begin + static_cast<std::uint64_t>(item / of_sample),
                           static_cast<std::uint64_t>(item % of_sample), splats);
        });
        context_.cancel().check();
        for (auto item = begin; item < end; ++item)
            add(splats_[static_cast<std::size_t>(item - begin)],
                (samples_.begin + static_cast<std::uint64_t>(item / of_sample)) % randomisations);
    }

    void trace_item(std::uint64_t sample, std::uint64_t part, std::vector<Splat>& splats) const {
        const auto key = key_of_sample(context_.inputs().seed, sample);
        const auto paths = static_cast<std::uint64_t>(tracer_.film().pixels());
        const auto first = part * paths_of_item, last = std::min(first + paths_of_item, paths);
        LightTracer::Counts counts;
        for (auto path = first; path < last; ++path)
            tracer_.trace(passes::PathSampler(key, static_cast<std::uint32_t>(path)), splats, counts);
        resources_.tally->rays += counts.rays;
        if (counts_) resources_.tally->cut += counts.cut;
    }

    void add(const std::vector<Splat>& splats, std::size_t randomisation) {
        const float share = 1 / static_cast<float>(tracer_.film().pixels());
        for (const auto& [pixel, scatterings, light] : splats) {
            if (!is_finite(light)) {
                if (counts_) ++resources_.tally->bad;
                continue;
            }
            const auto value = glm::vec4(share * light, 0);
            sums_[randomisation][pixel] += value;
            if (resources_.layers <= randomisations) continue;
            sums_[scatterings == 1 ? direct_layer : indirect_layer][pixel] += value;
        }
    }

    const graph::PassContext& context_;
    const LightTracing& resources_;
    SampleRange samples_;
    std::shared_ptr<passes::Bvh> bvh_;
    std::shared_ptr<passes::SurfaceLookup> surfaces_;
    std::shared_ptr<passes::LightSampler> lights_, indirect_lights_;
    std::shared_ptr<passes::EmissionSampler> emission_;
    PathWorld world_;
    SharedPaths shared_;
    LightTracer tracer_;
    std::vector<std::span<glm::vec4>> sums_;
    std::vector<std::vector<Splat>> splats_;  ///< by item
    const bool counts_;
};

}  // namespace

graph::ImageRef trace_light(graph::GraphBuilder& builder, const PathInputs& inputs,
                            const Parameters& parameters, const SharpMaterials& materials,
                            const Progress& progress, const std::shared_ptr<Tally>& tally, int layers) {
    LightTracing r{inputs, materials, progress, tally, {}, layers};
    r.sums = builder.image(
        {.text = {.key = "reference.light_sums",
                  .label = "Sums of traced light",
                  .doc = "Of light over mirrors, through glass and over sharp surfaces, traced from its "
                         "sources: layers as those of the sums.",
                  .semantic = Semantic::radiance,
                  .unit = "W/(m² sr)"},
         .format = gl::Format::rgba32f,
         .layers = layers});
    const auto declared = parameters.samples * items_of_sample(builder.inputs().view);
    builder.pass("trace light", graph::Queue::cpu)
        .reads(inputs.bvh, inputs.surfaces, inputs.lights, inputs.indirect_lights, *inputs.emission)
        .reads_previous(r.sums, progress.buffer())
        .writes(r.sums)
        .execute_sliced(
            declared,
            [=](graph::PassContext& context, graph::Slice slice) {
                SplatTracer(context, r, parameters).run(slice, declared);
            },
            2);
    return r.sums;
}

}  // namespace ir::methods::reference
