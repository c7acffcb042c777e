#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "renderers/graph/pass_context.h"

namespace ir::methods::reference {

/// Consecutive samples of one pixel.
struct SampleRange {
    std::uint64_t begin = 0, end = 0;
    bool empty() const { return begin >= end; }
};

/// What a frame's passes count, beyond 32 bits; made anew by each setup. Thread-safe where it says so.
struct Tally {
    std::atomic<std::uint64_t> rays{0};   ///< thread-safe
    std::atomic<std::uint64_t> paths{0};  ///< thread-safe
    std::atomic<std::uint64_t> cut{0};  ///< thread-safe: paths ended by the limit of mirror and glass events
    std::atomic<std::uint64_t> bad{0};  ///< thread-safe: samples that were no finite number
    double milliseconds = 0;            ///< spent on tracing
};

/// Over all frames that the result is made of.
struct Totals {
    std::uint64_t samples = 0;  ///< of each pixel
    std::uint64_t bad = 0;      ///< samples of all pixels that were no finite number; they count as black
    std::uint64_t cut = 0;      ///< paths of all pixels ended by the limit of mirror and glass events
};

/// How far the samples have come, the same for all pixels: a small buffer with history.
class Progress {
  public:
    Progress() = default;
    /// Declares the buffer "reference.progress".
    explicit Progress(graph::GraphBuilder& builder);
    graph::BufferRef buffer() const { return buffer_; }

    /// Whether the frame adds to an earlier one.
    static bool continues(const graph::PassContext& context);
    /// The samples that a frame has to trace: `per_frame` behind those that its history holds, fewer where
    /// the inputs limit them; empty where the history, which may come from a file, is only shown.
    SampleRange of_frame(const graph::PassContext& context, std::uint64_t per_frame) const;
    /// Once of_frame() is traced, by a pass that writes the buffer.
    Totals advance(const graph::PassContext& context, std::uint64_t per_frame, const Tally& tally) const;
    /// Adds what another shard counted in as many samples to the bytes of a buffer. Throws Error where it has
    /// others.
    static void join(std::span<std::byte> whole, std::span<const std::byte> part);

  private:
    graph::BufferRef buffer_;
};

/// Figures of a frame: rays, paths per second, samples in all, and the estimated error of the main result;
/// and a warning where samples were no finite number. `mean_variance`: over valid pixels and channels.
void report_figures(const graph::PassContext& context, const Tally& tally, const Totals& totals,
                    double mean_variance);

}  // namespace ir::methods::reference
