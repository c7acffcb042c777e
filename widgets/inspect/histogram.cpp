#include "widgets/inspect/histogram.h"

#include <algorithm>
#include <cmath>

#include "renderers/image/channels.h"

namespace ir::widgets {
namespace {

std::vector<int> channels_of(const Image& image, Semantic semantic, int channel) {
    if (channel >= 0) return channel < image.channels ? std::vector{channel} : std::vector<int>{};
    std::vector<int> all;
    for (int c = 0; c < value_channels(semantic, image.channels); ++c) all.push_back(c);
    return all;
}

/// Calls visit(channel's number in the list, value) for the pixels that count, until cancelled.
template <class Visit>
void for_each_value(const Image& image, const std::vector<int>& channels, const Counted& counted,
                    const std::atomic<bool>* cancelled, Visit visit) {
    if (channels.empty() || image.empty()) return;
    const bool masked = counted.valid && counted.valid->width == image.width &&
                        counted.valid->height == image.height && counted.valid->channels == 1;
    for (const AtlasTile& tile : tiles_of(image, counted.atlas))
        for (int y = tile.y; y < std::min(tile.y + tile.height, image.height); ++y) {
            if (cancelled && cancelled->load()) return;
            for (int x = tile.x; x < std::min(tile.x + tile.width, image.width); ++x) {
                if (masked && !(counted.valid->at(x, y) > 0.5f)) continue;
                const float* pixel = &image.pixels[image.index(x, y)];
                for (std::size_t c = 0; c < channels.size(); ++c) visit(c, pixel[channels[c]]);
            }
        }
}

double quantile(std::vector<float>& values, double fraction) {
    const auto nth = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

Axis chosen_axis(const Histogram& numbers) {
    Axis axis{numbers.min, numbers.max};
    const double inner = numbers.percentile_99 - numbers.percentile_1;
    if (inner > 0 && inner < 0.1 * (axis.high - axis.low))
        axis = {std::max(axis.low, numbers.percentile_1 - 0.25 * inner),
                std::min(axis.high, numbers.percentile_99 + 0.25 * inner)};
    if (axis.high > axis.low) return axis;
    const double room = axis.low == 0 ? 0.5 : std::abs(axis.low) * 0.5;
    return {axis.low - room, axis.high + room};
}

}  // namespace

Histogram histogram(const Image& image, int channel, const std::optional<Axis>& axis, const Counted& counted,
                    const std::atomic<bool>* cancelled) {
    Histogram result;
    result.channels = channels_of(image, counted.semantic, channel);
    result.counts.resize(result.channels.size());
    std::vector<float> finite;
    finite.reserve(image.pixels.size() / std::size_t(std::max(image.channels, 1)) * result.channels.size());
    for (const auto& tile : tiles_of(image, counted.atlas))
        result.pixels += std::size_t(tile.width) * std::size_t(tile.height);
    for_each_value(image, result.channels, counted, cancelled, [&](std::size_t c, float value) {
        result.valid += c == 0;
        if (std::isnan(value)) return void(++result.nan);
        if (std::isinf(value)) return void(++result.infinite);
        result.negative += value < 0;
        finite.push_back(value);
    });
    result.finite = finite.size();
    if (finite.empty() || (cancelled && cancelled->load())) {
        if (axis) result.axis = *axis;
        return result;
    }
    const auto [min, max] = std::minmax_element(finite.begin(), finite.end());
    result.min = *min;
    result.max = *max;
    result.percentile_1 = quantile(finite, 0.01);
    result.percentile_99 = quantile(finite, 0.99);
    result.axis = axis && axis->high > axis->low ? *axis : chosen_axis(result);

    const double scale = Histogram::bins / (result.axis.high - result.axis.low);
    for_each_value(image, result.channels, counted, cancelled, [&](std::size_t c, float value) {
        if (!std::isfinite(value)) return;
        if (value < result.axis.low) return void(++result.below);
        if (value > result.axis.high) return void(++result.above);
        const int bin = std::min(int((value - result.axis.low) * scale), Histogram::bins - 1);
        ++result.counts[c][std::size_t(bin)];
    });
    return result;
}

}  // namespace ir::widgets
