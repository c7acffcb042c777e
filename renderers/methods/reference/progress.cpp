#include "renderers/methods/reference/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "renderers/core/error.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::methods::reference {
namespace {

/// Words of the buffer; samples of all pixels may need 64 bits, low word first.
constexpr std::size_t bad_word = 1, cut_word = 3, words_of_buffer = 5;

std::uint64_t word_pair(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{high} << 32 | low;
}
void write_words(std::span<std::uint32_t> words, std::uint64_t number) {
    words[0] = static_cast<std::uint32_t>(number);
    words[1] = static_cast<std::uint32_t>(number >> 32);
}

}  // namespace

Progress::Progress(graph::GraphBuilder& builder) {
    graph::BufferDesc desc;
    desc.text = {.key = "reference.progress",
                 .label = "Progress",
                 .doc =
                     "How many paths each pixel has; of all pixels, samples that were no number, and paths "
                     "that were cut (low word first)."};
    desc.fields = {{"samples", graph::FieldType::u32},
                   {"bad_samples", graph::FieldType::u32, 2},
                   {"cut_paths", graph::FieldType::u32, 2}};
    desc.elements = 1;
    buffer_ = builder.buffer(std::move(desc));
}

bool Progress::continues(const graph::PassContext& context) {
    return context.has_previous() &&
           passes::stands_still(context.inputs(), passes::Watched::surfaces_and_lights);
}

SampleRange Progress::of_frame(const graph::PassContext& context, std::uint64_t per_frame) const {
    const auto added = std::min(per_frame, context.inputs().sample_limit);
    if (!continues(context)) return {0, std::max<std::uint64_t>(1, added)};
    const std::uint64_t before = context.previous_contents<std::uint32_t>(buffer_)[0];
    return {before, before + added};
}

Totals Progress::advance(const graph::PassContext& context, std::uint64_t per_frame,
                         const Tally& tally) const {
    Totals totals{of_frame(context, per_frame).end, tally.bad, tally.cut};
    if (continues(context)) {
        const auto before = context.previous_contents<std::uint32_t>(buffer_);
        totals.bad += word_pair(before[bad_word], before[bad_word + 1]);
        totals.cut += word_pair(before[cut_word], before[cut_word + 1]);
    }
    const auto words = context.elements<std::uint32_t>(buffer_);
    words[0] = static_cast<std::uint32_t>(totals.samples);
    write_words(words.subspan(bad_word, 2), totals.bad);
    write_words(words.subspan(cut_word, 2), totals.cut);
    return totals;
}

void Progress::join(std::span<std::byte> whole, std::span<const std::byte> part) {
    std::array<std::uint32_t, words_of_buffer> sum{}, added{};
    if (whole.size() != sizeof sum || part.size() != sizeof added)
        throw Error("parts of a picture do not count what they have");
    std::memcpy(sum.data(), whole.data(), sizeof sum);
    std::memcpy(added.data(), part.data(), sizeof added);
    if (sum[0] != added[0])
        throw Error("parts of a picture have " + std::to_string(sum[0]) + " and " + std::to_string(added[0]) +
                    " samples; run those that have fewer again");
    for (const auto word : {bad_word, cut_word})
        write_words(std::span(sum).subspan(word, 2),
                    word_pair(sum[word], sum[word + 1]) + word_pair(added[word], added[word + 1]));
    std::memcpy(whole.data(), sum.data(), sizeof sum);
}

namespace {

/// The RMSE that renderers are compared at, in the result's unit.
constexpr double compared_error = 0.02;

void warn_of_bad_samples(const graph::PassContext& context, const Totals& totals) {
    if (totals.bad == 0) return;
    context.notes().warn(
        std::to_string(totals.bad) + (totals.bad == 1 ? " sample was" : " samples were") +
        " no finite number and counted as black: the picture is too dark there; look for extreme "
        "radiances and for degenerate triangles in the scene");
}

}  // namespace

void report_figures(const graph::PassContext& context, const Tally& tally, const Totals& totals,
                    double mean_variance) {
    const auto samples = static_cast<double>(totals.samples);
    const auto& view = context.inputs().view;
    const auto pixels = static_cast<double>(view.width) * view.height;
    context.notes().set_sum("rays", static_cast<double>(tally.rays));
    context.notes().set_sum("reference.trace_ms", tally.milliseconds);
    context.notes().set_figure("reference.samples_total", pixels * samples);
    context.notes().set_figure("reference.error", std::sqrt(mean_variance));
    // All samples made the variance, this frame's the time. Variance falls as 1 / time, or faster.
    const auto paths = static_cast<double>(tally.paths);
    const double all_ms = paths > 0 ? tally.milliseconds * pixels * samples / paths : 0;
    context.notes().set_figure("reference.ms_to_rmse_0.02",
                               all_ms * mean_variance / (compared_error * compared_error));
    context.notes().set_figure("reference.cut_paths", static_cast<double>(totals.cut));
    context.notes().set_figure("reference.bad_samples", static_cast<double>(totals.bad));
    warn_of_bad_samples(context, totals);
}

}  // namespace ir::methods::reference
