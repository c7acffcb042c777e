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
    static constexpr int size = 16;  ///< pixels along a side

    /// `block` in samples.
    Tiles(const graph::FrameInputs& inputs, std::uint64_t block)
        : width_(inputs.view.width), height_(inputs.view.height), block_(block), shard_(inputs.shard) {}

    /// Whether the shard of a picture of this width has the tile. Each row of tiles is dealt in turn, and
    /// rows begin with others, so that shards are equally hard.
    static bool has_tile(const Shard& shard, int width, std::int64_t tile) {
        return (tile + tile / across(width)) % shard.count == shard.index - 1;
    }
    bool has_tile(std::int64_t tile) const { return has_tile(shard_, width_, tile); }
    static bool has_pixel(const Shard& shard, int width, std::size_t pixel) {
        const auto row = static_cast<std::int64_t>(pixel) / width,
                   column = static_cast<std::int64_t>(pixel) % width;
        return has_tile(shard, width, row / size * across(width) + column / size);
    }
    bool has_pixel(std::size_t pixel) const { return has_pixel(shard_, width_, pixel); }

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
        const int left = static_cast<int>(tile % across(width_)) * size;
        const int top = static_cast<int>(tile / across(width_)) * size;
        for (int y = top; y < std::min(top + size, height_); ++y)
            for (int x = left; x < std::min(left + size, width_); ++x) visit(x, y);
    }

  private:
    static int across(int pixels) { return (pixels + size - 1) / size; }
    int width_, height_;
    std::uint64_t block_;
    Shard shard_;
};

/// Fills the layers of `sums`, rgba32f, with those of the frames before, or with zeros where this frame is
/// the first.
void start_sums(const graph::PassContext& context, graph::ImageRef sums, int layers);

/// Items that a frame is declared to have; how many it really has is only known when it runs.
std::int64_t declared_items(const Tiles& tiles, std::uint64_t per_frame);

/// Runs the part of a frame's work that a slice of the declared items stands for: all tiles of one block of
/// samples in parallel, then the next, so that a pixel's samples come in order. Tiles of other shards are
/// left out. Throws Cancelled.
void run_tiles(const graph::PassContext& context, const Tiles& tiles, SampleRange samples, graph::Slice slice,
               std::int64_t declared, const std::function<void(std::int64_t tile, SampleRange)>& trace);

}  // namespace ir::methods::reference
