#include "renderers/image/pixel_numbers.h"

#include <cmath>

#include "renderers/image/channels.h"
#include "renderers/image/luminance.h"

namespace ir {

double PixelNumber::of(const float* pixel) const {
    if (kind == Kind::channel) return pixel[channel];
    if (kind == Kind::luminance) return luminance<double>(pixel[0], pixel[1], pixel[2]);
    double sum = 0;
    for (int c = 0; c < channel; ++c) sum += double(pixel[c]) * pixel[c];
    return std::sqrt(sum);
}

std::vector<std::string> channel_choices(Semantic semantic, int channels) {
    const int count = value_channels(semantic, channels);
    std::vector<std::string> names;
    if (channels <= 4) names = channel_names(semantic, channels);
    for (int c = int(names.size()); c < count; ++c) names.push_back(std::to_string(c));
    names.resize(std::size_t(count));
    return names;
}

std::vector<PixelNumber> pixel_numbers(Semantic semantic, int channels, int choice) {
    const auto names = channel_choices(semantic, channels);
    const int count = int(names.size());
    if (count == 0 || choice >= count) return {};
    if (choice >= 0) return {{names[std::size_t(choice)], PixelNumber::Kind::channel, choice}};
    if (count == 1) return {{"", PixelNumber::Kind::channel, 0}};
    if (choice == one_number && is_colour(semantic) && count == 3)
        return {{"luminance", PixelNumber::Kind::luminance, 3}};
    if (choice == one_number) return {{"length", PixelNumber::Kind::length, count}};
    std::vector<PixelNumber> all;
    for (int c = 0; c < count; ++c) all.push_back({names[std::size_t(c)], PixelNumber::Kind::channel, c});
    return all;
}

bool MeasuredImage::has_value(int x, int y) const {
    if (valid && !(valid->at(x, y) > 0.5f)) return false;
    return !atlas || atlas->tiles.empty() || atlas->tile_at(x, y);
}

}  // namespace ir
