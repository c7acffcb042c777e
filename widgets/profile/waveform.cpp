#include "widgets/profile/waveform.h"

#include <algorithm>
#include <cmath>

namespace ir::widgets {

int Waveform::pixel_of(int column) const {
    return rectangle.left() + int(std::int64_t(column) * rectangle.width() / std::max(1, columns));
}

Waveform waveform(const MeasuredImage& image, const std::vector<PixelNumber>& numbers, const QRect& rectangle,
                  const Axis& axis, const std::atomic<bool>& cancelled) {
    Waveform wave;
    wave.picture = image.label;
    wave.rectangle = rectangle;
    wave.columns = std::min(rectangle.width(), Waveform::max_columns);
    wave.axis = axis;
    for (const auto& number : numbers)
        wave.channels.push_back({number.name, std::vector<std::uint32_t>(std::size_t(Waveform::rows) *
                                                                         std::size_t(wave.columns))});
    const double per_value = Waveform::rows / (axis.high - axis.low);
    for (int column = 0; column < wave.columns && !cancelled; ++column)
        for (int x = wave.pixel_of(column); x < wave.pixel_of(column + 1); ++x)
            for (int y = rectangle.top(); y <= rectangle.bottom(); ++y) {
                if (!image.has_value(x, y)) continue;
                const float* pixel = &image.image->pixels[image.image->index(x, y)];
                for (std::size_t c = 0; c < numbers.size(); ++c) {
                    const double value = numbers[c].of(pixel);
                    if (!(value >= axis.low && value <= axis.high)) continue;
                    const int row = std::min(int((value - axis.low) * per_value), Waveform::rows - 1);
                    auto& count =
                        wave.channels[c]
                            .counts[std::size_t(row) * std::size_t(wave.columns) + std::size_t(column)];
                    wave.most = std::max(wave.most, ++count);
                }
            }
    return wave;
}

}  // namespace ir::widgets
