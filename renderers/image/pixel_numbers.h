#pragma once

#include <string>
#include <vector>

#include "renderers/core/output.h"
#include "renderers/image/atlas.h"
#include "renderers/image/image.h"

namespace ir {

/// What is read of pixels besides a channel by its number.
inline constexpr int all_channels = -1;  ///< each that is a value (channels.h)
inline constexpr int one_number = -2;    ///< luminance of colours, length of vectors, else the value

/// A number that a pixel has.
struct PixelNumber {
    enum class Kind { channel, luminance, length };
    std::string name;  ///< "R"; empty where the pixel is one value
    Kind kind = Kind::channel;
    int channel = 0;  ///< or how many of them are the vector's
    double of(const float* pixel) const;
};
/// Those of an image's pixels; empty where it has no such channel.
std::vector<PixelNumber> pixel_numbers(Semantic semantic, int channels, int choice);
/// What may be chosen of such images besides the two above: names of their channels.
std::vector<std::string> channel_choices(Semantic semantic, int channels);

/// An image and where it has values. Nothing of it is owned.
struct MeasuredImage {
    std::string label;
    const Image* image = nullptr;
    const Image* valid =
        nullptr;  ///< one channel of the same size, above 0.5 where there is a value; null: all
    const Atlas* atlas = nullptr;  ///< between its tiles is nothing; null: a plain image
    Semantic semantic = Semantic::generic;
    bool has_value(int x, int y) const;
};

}  // namespace ir
