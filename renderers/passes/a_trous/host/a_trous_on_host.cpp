#include "renderers/passes/a_trous/host/a_trous_on_host.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "renderers/core/threads.h"
#include "renderers/passes/a_trous/host/filter_planes.h"
#include "renderers/passes/surface/octahedral.h"
#include "shaders/passes/a_trous/surface.glsl.h"

namespace ir::passes::a_trous {
namespace {

constexpr int rows_at_once = 4;
constexpr float nothing = std::numeric_limits<float>::infinity();

/// The images of a step on their way into planes and out.
class HostStep {
  public:
    HostStep(const Step& step, const Options& options, int threads)
        : step_(step), options_(options), arena_(arena_size(threads)) {}

    void begin(const graph::PassContext& p) {
        const auto& view = p.inputs().view;
        const auto& kernel = options_.kernel == Kernel::b3_spline ? b3_spline_kernel : printed_kernel;
        rules_ = {.edges = edges(p.inputs(), options_),
                  .kernel = {kernel[0], kernel[1], kernel[2]},
                  .detail_clip = options_.detail_clip,
                  .sigma_value = options_.sigma_value,
                  .bounds_dark_details = options_.bounds_dark_details,
                  .stride = 1 << step_.index};
        planes_.resize(view.width, view.height, 2 * rules_.stride,
                       step_.from.direction ? FilterPlanes::channels : 4);
        arena_.execute([&] { tbb::parallel_for(0, view.height, [&](int y) { fill_row(p, y); }); });
    }

    /// Until the next frame other steps need the memory.
    void end() { planes_ = {}; }

    void run(const graph::PassContext& p, int first_row, int end_row) {
        arena_.execute([&] {
            tbb::enumerable_thread_specific<FilteredRow> scratch(planes_.width);
            tbb::parallel_for(first_row, end_row, [&](int y) {
                auto& row = scratch.local();
                if (options_.is_guided()) {
                    filter_guided_row(planes_, rules_, y, row);
                    write_guided_row(p, y, row);
                } else {
                    filter_row(planes_, rules_, y, row);
                    write_row(p, y, row);
                }
            });
        });
    }

  private:
    std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(planes_.width) +
               static_cast<std::size_t>(x);
    }

    void fill_row(const graph::PassContext& p, int y) {
        const auto surfaces = p.pixels<const glm::uvec2>(step_.surfaces);
        const auto values = p.pixels<const glm::vec4>(step_.from.value);
        const auto directions = step_.from.direction ? p.pixels<const glm::vec2>(*step_.from.direction)
                                                     : std::span<const glm::vec2>();
        for (int x = 0; x < planes_.width; ++x) {
            const auto from = pixel(x, y), to = planes_.place(x, y);
            const float depth = glm::uintBitsToFloat(surfaces[from].y);
            if (!(depth < nothing)) continue;
            planes_.depth[to] = depth;
            const auto normal = unpacked_direction(surfaces[from].x);
            for (int i = 0; i < 3; ++i) planes_.normal[i][to] = normal[i];
            for (int i = 0; i < 4; ++i) planes_.value[i][to] = values[from][i];
            if (directions.empty()) continue;
            planes_.value[4][to] = directions[from].x, planes_.value[5][to] = directions[from].y;
        }
    }

    void write_guided_row(const graph::PassContext& p, int y, const FilteredRow& row) const {
        const auto next = p.pixels<glm::vec4>(step_.is_last ? step_.sum.value : step_.to.value);
        for (int x = 0; x < planes_.width; ++x) next[pixel(x, y)] = value_of(row.next, x);
    }

    void write_row(const graph::PassContext& p, int y, const FilteredRow& row) const {
        const auto sums = p.pixels<glm::vec4>(step_.sum.value);
        const auto direction_sums = p.pixels<glm::vec2>(*step_.sum.direction);
        for (int x = 0; x < planes_.width; ++x) {
            const auto at = pixel(x, y);
            auto value = value_of(row.clipped, x);
            auto direction = direction_of(row.clipped, x);
            if (!step_.is_first) value += sums[at], direction += direction_sums[at];
            if (step_.is_last) value += value_of(row.next, x), direction += direction_of(row.next, x);
            sums[at] = value, direction_sums[at] = direction;
        }
        if (step_.is_last) return;
        const auto next = p.pixels<glm::vec4>(step_.to.value);
        const auto next_direction = p.pixels<glm::vec2>(*step_.to.direction);
        for (int x = 0; x < planes_.width; ++x) {
            next[pixel(x, y)] = value_of(row.next, x);
            next_direction[pixel(x, y)] = direction_of(row.next, x);
        }
    }

    using Channels = std::vector<float>[FilterPlanes::channels];
    static glm::vec4 value_of(const Channels& row, int x) {
        const auto at = static_cast<std::size_t>(x);
        return {row[0][at], row[1][at], row[2][at], row[3][at]};
    }
    static glm::vec2 direction_of(const Channels& row, int x) {
        const auto at = static_cast<std::size_t>(x);
        return {row[4][at], row[5][at]};
    }

    Step step_;
    Options options_;
    tbb::task_arena arena_;
    FilterRules rules_{};
    FilterPlanes planes_;
};

}  // namespace

void FilterPlanes::resize(int w, int h, int reach, int used) {
    width = w, height = h, pad = reach, row = w + 2 * reach + vector;
    const auto count = static_cast<std::size_t>(row) * static_cast<std::size_t>(h);
    depth.assign(count, nothing);
    for (auto& axis : normal) axis.assign(count, 0.0f);
    for (int i = 0; i < used; ++i) value[i].assign(count, 0.0f);
}

FilteredRow::FilteredRow(int width) {
    for (auto* channels : {&next, &clipped})
        for (auto& channel : *channels)
            channel.resize(static_cast<std::size_t>(width + FilterPlanes::vector));
}

void filter_on_host(graph::GraphBuilder& builder, const Step& step, const Options& options,
                    const std::string& name) {
    const int height = builder.inputs().view.height;
    const auto host = std::make_shared<HostStep>(step, options, builder.inputs().threads);
    auto pass = builder.pass(name, graph::Queue::cpu);
    pass.has_two_bodies().reads(step.surfaces, step.from.value);
    if (step.from.direction) pass.reads(*step.from.direction);
    if (options.is_guided()) {
        pass.writes(step.is_last ? step.sum.value : step.to.value);
    } else {
        pass.writes(step.sum.value, *step.sum.direction);
        if (!step.is_last) pass.writes(step.to.value, *step.to.direction);
    }
    const int blocks = (height + rows_at_once - 1) / rows_at_once;
    pass.execute_sliced(
        blocks,
        [=](graph::PassContext& p, graph::Slice slice) {
            if (slice.first) host->begin(p);
            host->run(p, static_cast<int>(slice.begin) * rows_at_once,
                      std::min(static_cast<int>(slice.end) * rows_at_once, height));
            if (slice.last) host->end();
        },
        std::max(1, blocks / 8));
}

}  // namespace ir::passes::a_trous
