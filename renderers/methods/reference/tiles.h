#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "renderers/methods/reference/progress.h"

namespace ir::methods::reference {

/// The work of a frame: square tiles of pixels times blocks of samples. Blocks begin at multiples of their
/// size, whatever frames and sessions traced before.
class Tiles {
  public:
    /// `size` in pixels; `block` in samples.
    Tiles(int width, int height, int size, std::uint64_t block)
        : width_(width), height_(height), size_(size), block_(block) {}

    std::int64_t count() const { return std::int64_t{across(width_)} * across(height_); }
    std::int64_t blocks(SampleRange samples) const {
        if (samples.empty()) return 0;
        return static_cast<std::int64_t>((samples.end - 1) / block_ - samples.begin / block_ + 1);
    }
    /// Block `i` of these samples.
    SampleRange block(SampleRange samples, std::int64_t i) const {
        const auto begin = (samples.begin / block_ + static_cast<std::uint64_t>(i)) * block_;
        return {std::max(samples.begin, begin), std::min(samples.end, begin + block_)};
    }
    /// Calls `visit(x, y)` for the pixels of a tile.
    template <class Visit>
    void for_each_pixel(std::int64_t tile, Visit visit) const {
        const int left = static_cast<int>(tile % across(width_)) * size_;
        const int top = static_cast<int>(tile / across(width_)) * size_;
        for (int y = top; y < std::min(top + size_, height_); ++y)
            for (int x = left; x < std::min(left + size_, width_); ++x) visit(x, y);
    }

  private:
    int across(int pixels) const { return (pixels + size_ - 1) / size_; }
    int width_, height_, size_;
    std::uint64_t block_;
};

/// Items that a frame is declared to have; how many it really has is only known when it runs.
std::int64_t declared_items(const Tiles& tiles, std::uint64_t per_frame);

/// Runs the part of a frame's work that a slice of the declared items stands for: all tiles of one block of
/// samples in parallel, then the next, so that a pixel's samples come in order. Throws Cancelled.
void run_tiles(const graph::PassContext& context, const Tiles& tiles, SampleRange samples, graph::Slice slice,
               std::int64_t declared, const std::function<void(std::int64_t tile, SampleRange)>& trace);

}  // namespace ir::methods::reference
