#pragma once

#include <QRect>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "renderers/image/pixel_numbers.h"
#include "widgets/inspect/histogram.h"

namespace ir::widgets {

/// How often values occur in the columns of a picture: what oscilloscopes of video show.
struct Waveform {
    static constexpr int rows = 128, max_columns = 512;
    struct Channel {
        std::string name;                   ///< "R"; empty where a pixel is one value
        std::vector<std::uint32_t> counts;  ///< rows × columns; row 0 holds the lowest values
    };
    std::string picture;
    QRect rectangle;  ///< pixels that were looked at
    int columns = 0;  ///< one a pixel, or as many as there may be, each for several pixels
    Axis axis;        ///< from the lower edge of the lowest row to the upper one of the highest
    std::vector<Channel> channels;
    std::uint32_t most = 0;  ///< largest count
    std::uint32_t count(std::size_t channel, int column, int row) const {
        return channels[channel].counts[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
    }
    /// First pixel of a column, of the picture; of `columns`: the one behind the rectangle.
    int pixel_of(int column) const;
};

/// Values beyond the axis and pixels without one are left out. Returns early, with what it has, once
/// `cancelled`.
Waveform waveform(const MeasuredImage& image, const std::vector<PixelNumber>& numbers, const QRect& rectangle,
                  const Axis& axis, const std::atomic<bool>& cancelled);

}  // namespace ir::widgets
