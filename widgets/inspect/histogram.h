#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/atlas.h"
#include "renderers/image/image.h"

namespace ir::widgets {

/// What a histogram spans.
struct Axis {
    double low = 0, high = 1;
    bool operator==(const Axis&) const = default;
};

/// How often values occur, in equally wide bins over an axis.
struct Histogram {
    static constexpr int bins = 256;
    double min = 0, max = 0;                     ///< of the finite values; 0 when there are none
    double percentile_1 = 0, percentile_99 = 0;  ///< of the finite values
    std::size_t finite = 0, nan = 0, infinite = 0, negative = 0;
    std::size_t valid = 0, pixels = 0;  ///< pixels that count, and all
    Axis axis;
    std::size_t below = 0, above = 0;                     ///< finite values beyond the axis
    std::vector<int> channels;                            ///< numbers of the channels in `counts`
    std::vector<std::array<std::uint64_t, bins>> counts;  ///< one by channel
    bool operator==(const Histogram&) const = default;
};

/// Which pixels and channels count.
struct Counted {
    const Image* valid = nullptr;            ///< one channel of the same size: those above 0.5; null: all
    Atlas atlas = {};                        ///< those within its tiles; empty: all
    Semantic semantic = Semantic::radiance;  ///< says which channels are values
};

/// Of one channel, or with -1 of those that are values (renderers/image/channels.h). Without an axis one is
/// chosen: all values, or where a few would squeeze the rest into a tenth of it, the 1st to the 99th
/// percentile with some room; never of width 0. Returns early, with what it has, once `cancelled`.
Histogram histogram(const Image& image, int channel = -1, const std::optional<Axis>& axis = {},
                    const Counted& counted = {}, const std::atomic<bool>* cancelled = nullptr);

}  // namespace ir::widgets
