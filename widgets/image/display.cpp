#include "widgets/image/display.h"

#include <algorithm>
#include <cmath>

#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exposure.h"
#include "widgets/image/preferred_maps.h"
#include "widgets/style/number_text.h"

namespace ir::widgets {
namespace {

bool may_be_negative(Semantic semantic) {
    return is_vector(semantic) || semantic == Semantic::generic || semantic == Semantic::id;
}

}  // namespace

Statistics statistics(const Image& image, Semantic semantic, const Atlas& atlas, int channel,
                      const Image* valid) {
    Statistics result;
    double sum = 0;
    const auto take = [&](float value) {
        if (std::isnan(value)) return void(++result.nan);
        if (std::isinf(value)) return void(++result.infinite);
        if (result.finite == 0) result.min = result.max = value;
        result.min = std::min<double>(result.min, value);
        result.max = std::max<double>(result.max, value);
        result.negative += value < 0;
        sum += value;
        ++result.finite;
    };
    const int first = std::max(channel, 0);
    const int end =
        channel < 0 ? value_channels(semantic, image.channels) : std::min(channel + 1, image.channels);
    for (const AtlasTile& tile : tiles_of(image, atlas))
        for (int y = tile.y; y < std::min(tile.y + tile.height, image.height); ++y)
            for (int x = tile.x; x < std::min(tile.x + tile.width, image.width); ++x) {
                ++result.pixels;
                if (valid && !(valid->at(x, y) > 0.5f)) continue;
                ++result.valid;
                for (int c = first; c < end; ++c) take(image.at(x, y, c));
            }
    if (result.finite) result.mean = sum / double(result.finite);
    return result;
}

ColourMap colours_of(const Display& display) {
    return display.categories.empty() ? colour_map(display.colour_map) : step_map(display.categories).colours;
}

Display display_for(Semantic semantic, const std::string& map, const Image& image, const Atlas& atlas,
                    const std::vector<Category>& categories) {
    Display display;
    if (!categories.empty() && image.channels == 1) {
        const auto steps = step_map(categories);
        display.mode = Display::Mode::scalar;
        display.categories = categories;
        display.low = steps.low;
        display.high = steps.high;
        display.negative_is_bad = false;
        return display;
    }
    display.colour_map = preferred_map(semantic, map);
    display.negative_is_bad = !may_be_negative(semantic);
    const Statistics numbers = statistics(image, semantic, atlas);
    const auto automatic = [&] {
        display.low = numbers.min;
        display.high = numbers.max;
    };
    const double largest = std::max({std::abs(numbers.min), std::abs(numbers.max), 1e-9});
    switch (semantic) {
        case Semantic::normal:
            display.mode = Display::Mode::vector;
            display.low = -1;
            break;
        case Semantic::velocity: {
            // Rounding in a still picture is not to look like motion.
            const double fastest = std::max(largest, 1e-3);
            display.mode = Display::Mode::vector;
            display.low = -fastest;
            display.high = fastest;
            break;
        }
        case Semantic::position:
            display.mode = Display::Mode::vector;
            automatic();
            break;
        case Semantic::id:
            display.mode = Display::Mode::ids;
            break;
        case Semantic::accessibility:
        case Semantic::probability:
        case Semantic::mask:
            display.mode = Display::Mode::scalar;
            if (numbers.max > 1) display.high = numbers.max;
            break;
        case Semantic::radiance:
        case Semantic::irradiance:
            display.exposure = automatic_exposure(image);
            [[fallthrough]];
        case Semantic::albedo:
            display.mode = Display::Mode::colour;
            break;
        default:
            display.mode = image.channels == 1 ? Display::Mode::scalar : Display::Mode::vector;
            automatic();
            if (numbers.min >= 0 && semantic != Semantic::depth) display.low = 0;
    }
    return display;
}

Image shown_channels(const Image& image, int channel) {
    if (image.channels <= 4 || image.empty()) return image;
    const int first = std::clamp(channel, 0, image.channels - 1);
    const int count = channel >= 0 ? 1 : 4;
    Image result(image.width, image.height, count);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < count; ++c) result.at(x, y, c) = image.at(x, y, first + c);
    return result;
}

QString short_number(double value) {
    return number_text(value, 4);
}

QString channel_name(Semantic semantic, int channels, int channel) {
    if (channels == 1) return QStringLiteral("Y");
    if (channels > 4) return QString::number(channel);
    return QString(QLatin1Char((is_vector(semantic) ? "XYZW" : "RGBA")[channel]));
}

bool shows(const float* pixel, int channels, const Category& category) {
    if (channels < 3) return std::abs(pixel[0] - static_cast<float>(category.value)) <= 0.5f;
    const auto colour = linear_from_srgb(category.colour);
    for (int c = 0; c < 3; ++c)
        if (std::abs(pixel[c] - colour[c]) > 0.01f) return false;
    return true;
}

const Category* category_at(const float* pixel, int channels, const std::vector<Category>& categories) {
    const auto found = std::find_if(categories.begin(), categories.end(),
                                    [&](const auto& each) { return shows(pixel, channels, each); });
    return found == categories.end() ? nullptr : &*found;
}

QColor colour_of(const Category& category) {
    return {category.colour[0], category.colour[1], category.colour[2]};
}

}  // namespace ir::widgets
