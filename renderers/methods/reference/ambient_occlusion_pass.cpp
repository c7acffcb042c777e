#include "renderers/methods/reference/ambient_occlusion_pass.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <glm/gtc/packing.hpp>
#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/reference/visibility.h"

namespace ir::methods::reference {
namespace {

/// One item of work: a tile and a portion of its samples, at most 65,536 rays or some tens of milliseconds,
/// so that cancelling never waits long.
constexpr int tile_size = 16;
constexpr std::uint64_t portion_samples = 256;

struct Resources {
    passes::GBuffer gbuffer;
    graph::ObjectRef bvh;
    graph::ImageRef sums_low, sums_high;  ///< rgba32f each: randomisations 0–3 and 4–7
    graph::ImageRef samples, accessibility, variance;
    /// A counter holds 32 bits, a frame may trace more rays: portions take turns, the report adds them up.
    std::vector<graph::CounterRef> rays;
};

graph::ImageDesc sums_desc(const std::string& part, const std::string& which) {
    return {.text = {.key = "reference.sums_" + part,
                     .label = "Sums, " + part,
                     .doc = "Sum of the visibility samples in randomisations " + which + ", over all frames.",
                     .semantic = Semantic::generic},
            .format = gl::Format::rgba32f};
}

Resources declare(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ObjectRef bvh,
                  std::uint64_t samples) {
    Resources r;
    r.gbuffer = gbuffer;
    r.bvh = bvh;
    r.sums_low = builder.image(sums_desc("low", "1–4"));
    r.sums_high = builder.image(sums_desc("high", "5–8"));
    r.samples = builder.image({.text = {.key = "reference.samples",
                                        .label = "Samples",
                                        .doc = "Paths per pixel so far.",
                                        .semantic = Semantic::count},
                               .format = gl::Format::r32ui});
    r.accessibility = builder.image({.text = {.key = "accessibility",
                                              .label = "Accessibility",
                                              .doc = "Mean visibility; background 1.",
                                              .semantic = Semantic::accessibility},
                                     .format = gl::Format::r32f});
    r.variance = builder.image({.text = {.key = "reference.variance",
                                         .label = "Variance of the mean",
                                         .doc = "Estimated from the differences between randomisations."},
                                .format = gl::Format::r32f});
    const auto& view = builder.inputs().view;
    const auto most_rays = static_cast<std::uint64_t>(view.width) * view.height * samples;
    for (std::uint64_t i = 0; i <= most_rays >> 32; ++i) {
        r.rays.push_back(builder.counter({.key = "rays", .label = "Rays", .doc = "Visibility rays traced."}));
    }
    return r;
}

/// Whether the last frame saw the same picture, so that its samples still count.
bool stands_still(const graph::FrameInputs& inputs) {
    const auto& now = inputs.view;
    const auto& before = inputs.previous_view;
    if (now.width != before.width || now.height != before.height || now.eye_ws != before.eye_ws ||
        now.clip_from_world() != before.clip_from_world()) {
        return false;
    }
    for (const auto& motion : inputs.world->motion) {
        if (motion != glm::mat4(1)) return false;
    }
    return true;
}

bool continues(const graph::PassContext& context) {
    return context.has_previous() && stands_still(context.inputs());
}

/// Samples of earlier frames that this one adds to; the same for all pixels.
std::uint64_t samples_before(const graph::PassContext& context, const Resources& r) {
    return continues(context) ? context.previous_pixels<std::uint32_t>(r.samples)[0] : 0;
}

/// What tracing reads and writes, on the host.
struct Pixels {
    Pixels(const graph::PassContext& context, const Resources& r)
        : width(context.shape(r.sums_low).width),
          height(context.shape(r.sums_low).height),
          positions(context.pixels<glm::vec4>(r.gbuffer.position)),
          geometric_normals(context.pixels<glm::vec4>(r.gbuffer.geometric_normal)),
          shading_normals(context.pixels<std::uint64_t>(r.gbuffer.normal)),
          low(context.pixels<glm::vec4>(r.sums_low)),
          high(context.pixels<glm::vec4>(r.sums_high)) {}

    bool is_background(std::size_t i) const { return glm::vec3(geometric_normals[i]) == glm::vec3(0); }

    SurfacePoint point(std::size_t i) const {
        const auto normal = glm::vec3(glm::unpackHalf4x16(shading_normals[i]));
        const float length = glm::length(normal);  // half floats: not quite 1
        const auto geometric = glm::normalize(glm::vec3(geometric_normals[i]));
        return {glm::vec3(positions[i]), geometric, length > 0.5f ? normal / length : geometric};
    }

    Sums sums(std::size_t i) const {
        return {low[i].x, low[i].y, low[i].z, low[i].w, high[i].x, high[i].y, high[i].z, high[i].w};
    }

    void set_sums(std::size_t i, const Sums& s) const {
        low[i] = {s[0], s[1], s[2], s[3]};
        high[i] = {s[4], s[5], s[6], s[7]};
    }

    int width, height;
    std::span<const glm::vec4> positions, geometric_normals;
    std::span<const std::uint64_t> shading_normals;
    std::span<glm::vec4> low, high;
};

int tiles_across(int pixels) {
    return (pixels + tile_size - 1) / tile_size;
}

std::uint64_t portions(std::uint64_t samples) {
    return (samples + portion_samples - 1) / portion_samples;
}

/// Calls `visit(x, y)` for the pixels of a tile.
template <class Visit>
void for_each_pixel(const Pixels& pixels, std::int64_t tile, Visit visit) {
    const auto across = tiles_across(pixels.width);
    const int left = static_cast<int>(tile % across) * tile_size;
    const int top = static_cast<int>(tile / across) * tile_size;
    for (int y = top; y < std::min(top + tile_size, pixels.height); ++y) {
        for (int x = left; x < std::min(left + tile_size, pixels.width); ++x) visit(x, y);
    }
}

/// Copies the sums of earlier frames, or zeros.
void start_sums(const graph::PassContext& context, const Resources& r, const Pixels& pixels) {
    if (!continues(context)) {
        std::fill(pixels.low.begin(), pixels.low.end(), glm::vec4(0));
        std::fill(pixels.high.begin(), pixels.high.end(), glm::vec4(0));
        return;
    }
    const auto low = context.previous_pixels<glm::vec4>(r.sums_low);
    const auto high = context.previous_pixels<glm::vec4>(r.sums_high);
    std::copy(low.begin(), low.end(), pixels.low.begin());
    std::copy(high.begin(), high.end(), pixels.high.begin());
}

/// Traces portions of tiles in the order of the declared items: all tiles of one portion, then the next.
/// Tiles run in parallel, a tile's portions one after another, so that sums do not depend on the threads.
class Tracer {
  public:
    Tracer(const graph::PassContext& context, const Resources& r, const Parameters& parameters)
        : context_(context),
          resources_(r),
          pixels_(context, r),
          bvh_(context.object<passes::Bvh>(r.bvh)),
          rule_{parameters.transport.max_distance, parameters.transport.falloff},
          first_sample_(samples_before(context, r)),
          end_sample_(first_sample_ + static_cast<std::uint64_t>(parameters.samples)),
          tiles_(std::int64_t{tiles_across(pixels_.width)} * tiles_across(pixels_.height)) {}

    void run(graph::Slice slice) const {
        if (slice.first) start_sums(context_, resources_, pixels_);
        const int threads = context_.inputs().threads;
        tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
        for (auto item = slice.begin; item < slice.end;) {
            const auto portion = item / tiles_;
            const auto end = std::min(slice.end, (portion + 1) * tiles_);
            arena.execute([&] {
                tbb::parallel_for(item, end, [&](std::int64_t i) {
                    if (!context_.cancel().is_cancelled()) trace_tile(i % tiles_, portion);
                });
            });
            context_.cancel().check();
            item = end;
        }
    }

  private:
    void trace_tile(std::int64_t tile, std::int64_t portion) const {
        const auto begin = first_sample_ + static_cast<std::uint64_t>(portion) * portion_samples;
        const SampleRange range{begin, std::min(end_sample_, begin + portion_samples)};
        std::uint32_t rays = 0;
        for_each_pixel(pixels_, tile, [&](int x, int y) {
            const auto i = static_cast<std::size_t>(y) * pixels_.width + x;
            if (pixels_.is_background(i)) return;
            const PixelSamples samples(context_.inputs().seed, x, y);
            auto sums = pixels_.sums(i);
            rays += add_visibility(*bvh_, pixels_.point(i), rule_, samples, range, sums);
            pixels_.set_sums(i, sums);
        });
        context_.add(resources_.rays[static_cast<std::size_t>(portion) % resources_.rays.size()], rays);
    }

    const graph::PassContext& context_;
    const Resources& resources_;
    Pixels pixels_;
    std::shared_ptr<passes::Bvh> bvh_;
    VisibilityRule rule_;
    std::uint64_t first_sample_, end_sample_;
    std::int64_t tiles_;
};

void average(const graph::PassContext& context, const Resources& r, const Parameters& parameters) {
    const Pixels pixels(context, r);
    const auto samples = samples_before(context, r) + static_cast<std::uint64_t>(parameters.samples);
    const auto accessibility = context.pixels<float>(r.accessibility);
    const auto variance = context.pixels<float>(r.variance);
    const auto counts = context.pixels<std::uint32_t>(r.samples);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        counts[i] = static_cast<std::uint32_t>(samples);
        const auto result = pixels.is_background(i) ? Estimate{.mean = 1} : estimate(pixels.sums(i), samples);
        accessibility[i] = static_cast<float>(result.mean);
        variance[i] = static_cast<float>(result.variance);
    }
}

}  // namespace

void ambient_occlusion(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, graph::ObjectRef bvh,
                       const Parameters& parameters) {
    const auto r = declare(builder, gbuffer, bvh, static_cast<std::uint64_t>(parameters.samples));
    const auto& view = builder.inputs().view;
    const auto tiles = std::int64_t{tiles_across(view.width)} * tiles_across(view.height);
    const auto items = tiles * static_cast<std::int64_t>(portions(parameters.samples));

    auto trace = builder.pass("trace visibility", graph::Queue::cpu);
    trace.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal, bvh)
        .reads_previous(r.sums_low, r.sums_high, r.samples)
        .writes(r.sums_low, r.sums_high);
    for (const auto counter : r.rays) trace.counts(counter);
    trace.execute_sliced(items, [r, parameters](graph::PassContext& context, graph::Slice slice) {
        Tracer(context, r, parameters).run(slice);
    });

    builder.pass("average", graph::Queue::cpu)
        .reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal, r.sums_low, r.sums_high)
        .reads_previous(r.samples)
        .writes(r.samples, r.accessibility, r.variance)
        .execute([r, parameters](graph::PassContext& context) { average(context, r, parameters); });
}

}  // namespace ir::methods::reference
