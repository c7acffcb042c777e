#include "renderers/methods/reference/progress.h"

#include <algorithm>
#include <cmath>

namespace ir::methods::reference {

bool stands_still(const graph::FrameInputs& inputs) {
    const auto& now = inputs.view;
    const auto& before = inputs.previous_view;
    if (now.width != before.width || now.height != before.height || now.eye_ws != before.eye_ws ||
        now.clip_from_world() != before.clip_from_world()) {
        return false;
    }
    // Lights on nodes may move where no surface does.
    const auto& lights = inputs.scene->lights;
    if (inputs.scene->is_animated() &&
        std::any_of(lights.begin(), lights.end(), [](const auto& light) { return light.node >= 0; })) {
        return false;
    }
    const auto& motion = inputs.world->motion;
    return std::all_of(motion.begin(), motion.end(), [](const auto& m) { return m == glm::mat4(1); });
}

Progress::Progress(graph::GraphBuilder& builder) {
    graph::BufferDesc desc;
    desc.text = {.key = "reference.progress", .label = "Progress", .doc = "How many paths each pixel has."};
    desc.fields = {{"samples", graph::FieldType::u32}};
    desc.elements = 1;
    buffer_ = builder.buffer(std::move(desc));
}

bool Progress::continues(const graph::PassContext& context) {
    return context.has_previous() && stands_still(context.inputs());
}

SampleRange Progress::of_frame(const graph::PassContext& context, std::uint64_t per_frame) const {
    if (!continues(context)) return {0, per_frame};
    const std::uint64_t before = context.previous_elements<std::uint32_t>(buffer_)[0];
    return {before, before + std::min(per_frame, context.inputs().sample_limit)};
}

void Progress::advance(const graph::PassContext& context, std::uint64_t per_frame) const {
    context.elements<std::uint32_t>(buffer_)[0] =
        static_cast<std::uint32_t>(of_frame(context, per_frame).end);
}

namespace {

/// The RMSE that renderers are compared at, in the result's unit.
constexpr double compared_error = 0.02;

}  // namespace

void report_figures(const graph::PassContext& context, const Tally& tally, std::uint64_t samples,
                    double mean_variance) {
    const auto& view = context.inputs().view;
    const auto pixels = static_cast<double>(view.width) * view.height;
    context.set_figure("rays", static_cast<double>(tally.rays));
    if (tally.milliseconds > 0) {
        context.set_figure("reference.samples_per_second",
                           static_cast<double>(tally.paths) / tally.milliseconds * 1e3);
    }
    context.set_figure("reference.trace_ms", tally.milliseconds);
    context.set_figure("reference.samples_total", pixels * static_cast<double>(samples));
    context.set_figure("reference.error", std::sqrt(mean_variance));
    // All samples made the variance, this frame's the time. Variance falls as 1 / time, or faster.
    const auto paths = static_cast<double>(tally.paths);
    const double all_ms = paths > 0 ? tally.milliseconds * pixels * static_cast<double>(samples) / paths : 0;
    context.set_figure("reference.ms_to_rmse_0.02",
                       all_ms * mean_variance / (compared_error * compared_error));
    context.set_figure("reference.cut_paths", static_cast<double>(tally.cut));
    context.set_figure("reference.bad_samples", static_cast<double>(tally.bad));
}

}  // namespace ir::methods::reference
