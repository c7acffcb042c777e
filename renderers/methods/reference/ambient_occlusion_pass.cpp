#include "renderers/methods/reference/passes.h"

#include <chrono>
#include <memory>

#include "renderers/core/half_float.h"
#include "renderers/methods/reference/tiles.h"
#include "renderers/methods/reference/visibility.h"

namespace ir::methods::reference {
namespace {

/// One item of work: at most 65,536 rays or some tens of milliseconds, so that cancelling never waits long.
/// Blocks are whole packets.
constexpr std::uint64_t visibility_block = 256;

struct VisibilityResources {
    PathInputs inputs;
    Progress progress;
    graph::ImageRef sums;  ///< rgba32f stack of two layers: randomisations 1–4 and 5–8
    graph::ImageRef samples, accessibility, variance;
    std::shared_ptr<Tally> tally = std::make_shared<Tally>();
};

VisibilityResources declare(graph::GraphBuilder& builder, const PathInputs& inputs) {
    VisibilityResources r;
    r.inputs = inputs;
    r.progress = Progress(builder);
    r.sums = builder.image({.text = {.key = "reference.sums",
                                     .label = "Sums",
                                     .doc = "Sums of the visibility samples over all frames, by "
                                            "randomisation: 1–4 and 5–8.",
                                     .semantic = Semantic::generic},
                            .format = gl::Format::rgba32f,
                            .layers = 2});
    r.samples = builder.output("reference.samples", {.format = gl::Format::r32ui});
    r.accessibility = builder.output("accessibility", {.format = gl::Format::r32f});
    r.variance = builder.output("reference.variance", {.format = gl::Format::r32f});
    return r;
}

/// The sums of a pixel, where they lie.
struct Layers {
    Layers(const graph::PassContext& context, graph::ImageRef image)
        : low(context.pixels<glm::vec4>(image, 0)), high(context.pixels<glm::vec4>(image, 1)) {}

    Sums sums(std::size_t i) const {
        return {low[i].x, low[i].y, low[i].z, low[i].w, high[i].x, high[i].y, high[i].z, high[i].w};
    }
    void set_sums(std::size_t i, const Sums& s) const {
        low[i] = {s[0], s[1], s[2], s[3]};
        high[i] = {s[4], s[5], s[6], s[7]};
    }
    std::span<glm::vec4> low, high;
};

/// The G-buffer's points on the host.
struct Points {
    Points(const graph::PassContext& context, const passes::GBuffer& gbuffer)
        : positions(context.pixels<glm::vec4>(gbuffer.position)),
          geometric_normals(context.pixels<glm::vec4>(gbuffer.geometric_normal)),
          shading_normals(context.pixels<std::uint64_t>(gbuffer.normal)) {}

    bool is_background(std::size_t i) const { return glm::vec3(geometric_normals[i]) == glm::vec3(0); }

    SurfacePoint at(std::size_t i) const {
        const auto normal = glm::vec3(unpack_halves(shading_normals[i]));
        const float length = glm::length(normal);  // half floats: not quite 1
        const auto geometric = glm::normalize(glm::vec3(geometric_normals[i]));
        return {glm::vec3(positions[i]), geometric, length > 0.5f ? normal / length : geometric};
    }
    std::span<const glm::vec4> positions, geometric_normals;
    std::span<const std::uint64_t> shading_normals;
};

class VisibilityTracer {
  public:
    VisibilityTracer(const graph::PassContext& context, const VisibilityResources& r,
                     const Parameters& parameters)
        : context_(context),
          resources_(r),
          tiles_(context.inputs(), visibility_block),
          samples_(r.progress.of_frame(context, static_cast<std::uint64_t>(parameters.samples))),
          layers_(context, r.sums),
          bvh_(context.object<passes::Bvh>(r.inputs.bvh)),
          rays_(passes::pixel_rays(context.inputs().view)),
          rule_{parameters.transport.max_distance, parameters.transport.falloff} {
        if (r.inputs.gbuffer)
            points_.emplace(context, *r.inputs.gbuffer);
        else
            surfaces_ = context.object<passes::SurfaceLookup>(r.inputs.surfaces);
    }

    void run(graph::Slice slice, std::int64_t declared) const {
        const auto start = std::chrono::steady_clock::now();
        if (slice.first) start_sums(context_, resources_.sums, 2);
        run_tiles(context_, tiles_, samples_, slice, declared,
                  [&](std::int64_t tile, SampleRange range) { trace(tile, range); });
        const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        resources_.tally->milliseconds += spent.count();
    }

  private:
    void trace(std::int64_t tile, SampleRange range) const {
        std::uint64_t rays = 0, paths = 0;
        tiles_.for_each_pixel(tile, [&](int x, int y) {
            const auto i = static_cast<std::size_t>(y) * context_.inputs().view.width + x;
            auto sums = layers_.sums(i);
            rays += add(i, {x, y}, range, sums);
            layers_.set_sums(i, sums);
            paths += range.end - range.begin;
        });
        resources_.tally->rays += rays;
        resources_.tally->paths += paths;
    }

    std::uint32_t add(std::size_t i, glm::ivec2 pixel, SampleRange range, Sums& sums) const {
        const auto seed = context_.inputs().seed;
        if (!points_) {
            return add_visibility_through_pixel({*bvh_, *surfaces_}, rays_, pixel,
                                                passes::pixel_key(seed, pixel.x, pixel.y), rule_, range,
                                                sums);
        }
        if (points_->is_background(i)) return 0;
        return add_visibility(*bvh_, points_->at(i), rule_, PixelSamples(seed, pixel.x, pixel.y), range,
                              sums);
    }

    const graph::PassContext& context_;
    const VisibilityResources& resources_;
    Tiles tiles_;
    SampleRange samples_;
    Layers layers_;
    std::shared_ptr<passes::Bvh> bvh_;
    std::shared_ptr<passes::SurfaceLookup> surfaces_;
    passes::PixelRays rays_;
    VisibilityRule rule_;
    std::optional<Points> points_;
};

void average(const graph::PassContext& context, const VisibilityResources& r, const Parameters& parameters) {
    const auto per_frame = static_cast<std::uint64_t>(parameters.samples);
    const auto totals = r.progress.advance(context, per_frame, *r.tally);
    const Tiles tiles(context.inputs(), visibility_block);
    const auto samples = totals.samples;
    const Layers layers(context, r.sums);
    std::optional<Points> points;
    if (r.inputs.gbuffer) points.emplace(context, *r.inputs.gbuffer);
    const auto accessibility = context.pixels<float>(r.accessibility);
    const auto variance = context.pixels<float>(r.variance);
    const auto counts = context.pixels<std::uint32_t>(r.samples);
    const auto valid = context.pixels<std::uint8_t>(r.inputs.valid);
    double sum_variance = 0, sum_valid = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        counts[i] = static_cast<std::uint32_t>(samples);
        const bool is_open = points && points->is_background(i);
        const auto result =
            is_open ? Estimate{.mean = 1} : estimate(layers.sums(i), samples, largest_variance_of_a_fraction);
        accessibility[i] = static_cast<float>(result.mean);
        variance[i] = static_cast<float>(result.variance);
        if (valid[i] == 0 || !tiles.has_pixel(i)) continue;
        sum_variance += result.variance;
        ++sum_valid;
    }
    report_figures(context, *r.tally, totals, sum_valid > 0 ? sum_variance / sum_valid : 0);
}

}  // namespace

void ambient_occlusion(graph::GraphBuilder& builder, const PathInputs& inputs, const Parameters& parameters) {
    const auto r = declare(builder, inputs);
    const auto declared =
        declared_items({builder.inputs(), visibility_block}, static_cast<std::uint64_t>(parameters.samples));
    auto trace = builder.pass("trace visibility", graph::Queue::cpu);
    trace.reads(inputs.bvh).reads_previous(r.sums, r.progress.buffer()).writes(r.sums);
    auto average_pass = builder.pass("average", graph::Queue::cpu);
    for (auto* pass : {&trace, &average_pass}) {
        if (inputs.gbuffer)
            pass->reads(inputs.gbuffer->position, inputs.gbuffer->normal, inputs.gbuffer->geometric_normal);
    }
    if (!inputs.gbuffer) trace.reads(inputs.surfaces);
    trace.execute_sliced(declared, [=](graph::PassContext& context, graph::Slice slice) {
        VisibilityTracer(context, r, parameters).run(slice, declared);
    });
    average_pass.reads(r.sums, inputs.valid)
        .reads_previous(r.progress.buffer())
        .writes(r.progress.buffer(), r.samples, r.accessibility, r.variance)
        .execute([=](graph::PassContext& context) { average(context, r, parameters); });
}

}  // namespace ir::methods::reference
