#include "widgets/image/display.h"

#include <algorithm>
#include <cmath>

#include "renderers/image/colour_map.h"

namespace ir::widgets {
namespace {

using Rgb = std::array<unsigned char, 3>;

unsigned char byte(double encoded) {
    return static_cast<unsigned char>(std::clamp(encoded, 0.0, 1.0) * 255 + 0.5);
}

/// Colour of a pixel whose numbers are wrong, checked in the order of how bad they are.
bool bad_colour(const Display& display, const float* values, int count, Rgb& colour) {
    bool negative = false, plus = false, minus = false;
    for (int c = 0; c < count; ++c) {
        if (std::isnan(values[c])) return colour = {255, 0, 255}, true;
        plus |= std::isinf(values[c]) && values[c] > 0;
        minus |= std::isinf(values[c]) && values[c] < 0;
        negative |= values[c] < 0;
    }
    if (plus) return colour = {255, 255, 0}, true;
    if (minus) return colour = {0, 255, 255}, true;
    if (negative && display.negative_is_bad) return colour = {40, 80, 255}, true;
    return false;
}

/// A well-spread colour per id: Knuth's multiplicative hash, one octet per component.
Rgb id_colour(float value) {
    std::uint32_t h = static_cast<std::uint32_t>(static_cast<std::int64_t>(value)) * 2654435761u;
    h ^= h >> 15;
    h *= 2246822519u;
    h ^= h >> 13;
    return {static_cast<unsigned char>(64 + (h & 127)), static_cast<unsigned char>(64 + ((h >> 8) & 127)),
            static_cast<unsigned char>(64 + ((h >> 16) & 127))};
}

double fraction(const Display& display, double value) {
    const double width = display.high - display.low;
    return width == 0 ? (value > display.low ? 1 : 0) : (value - display.low) / width;
}

Rgb scalar_colour(const Display& display, float value) {
    const auto& map = colour_map(display.colour_map);
    const double t = std::clamp(fraction(display, value), 0.0, 1.0);
    return map[static_cast<std::size_t>(t * 255 + 0.5)];
}

template <class Encode>
Rgb component_colour(const float* values, int count, Encode encode) {
    if (count == 1) return {encode(values[0]), encode(values[0]), encode(values[0])};
    return {encode(values[0]), encode(values[1]), count > 2 ? encode(values[2]) : encode(0)};
}

bool may_be_negative(Semantic semantic) {
    return semantic == Semantic::normal || semantic == Semantic::position || semantic == Semantic::velocity ||
           semantic == Semantic::generic || semantic == Semantic::id;
}

}  // namespace

Statistics statistics(const Image& image, int channel) {
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
    if (channel < 0)
        for (float value : image.pixels) take(value);
    else if (channel < image.channels)
        for (std::size_t i = channel; i < image.pixels.size(); i += image.channels) take(image.pixels[i]);
    if (result.finite) result.mean = sum / double(result.finite);
    return result;
}

Display display_for(Semantic semantic, const std::string& map, const Image& image) {
    Display display;
    display.colour_map = map.empty() ? default_colour_map(semantic) : map;
    display.negative_is_bad = !may_be_negative(semantic);
    const Statistics numbers = statistics(image);
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

Rgb shade(const Display& display, const float* pixel, int channels) {
    const bool single = display.channel >= 0 && display.channel < channels;
    const float* values = single ? pixel + display.channel : pixel;
    const int count = single ? 1 : std::min(channels, 3);
    Rgb colour{};
    if (display.mark_bad && bad_colour(display, values, count, colour)) return colour;
    switch (display.mode) {
        case Display::Mode::colour: {
            const double scale = std::exp2(display.exposure);
            return component_colour(values, count, [&](float v) {
                return byte(srgb_from_linear(static_cast<float>(std::max(0.0, v * scale))));
            });
        }
        case Display::Mode::vector:
            return component_colour(values, count, [&](float v) { return byte(fraction(display, v)); });
        case Display::Mode::scalar:
            return scalar_colour(display, values[0]);
        case Display::Mode::ids:
            return id_colour(values[0]);
    }
    return colour;
}

QImage to_qimage(const Image& image, const Display& display) {
    if (image.empty()) return {};
    QImage result(image.width, image.height, QImage::Format_RGB32);
    for (int y = 0; y < image.height; ++y) {
        auto* line = reinterpret_cast<QRgb*>(result.scanLine(y));
        for (int x = 0; x < image.width; ++x) {
            const Rgb colour = shade(display, &image.pixels[image.index(x, y)], image.channels);
            line[x] = qRgb(colour[0], colour[1], colour[2]);
        }
    }
    return result;
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
    if (std::isnan(value)) return QStringLiteral("NaN");
    if (std::isinf(value)) return value > 0 ? QStringLiteral("+Inf") : QStringLiteral("-Inf");
    return QString::number(value, 'g', 4);
}

QString channel_name(Semantic semantic, int channels, int channel) {
    const bool spatial =
        semantic == Semantic::normal || semantic == Semantic::position || semantic == Semantic::velocity;
    if (channels == 1) return QStringLiteral("Y");
    if (channels > 4) return QString::number(channel);
    return QString(QLatin1Char((spatial ? "XYZW" : "RGBA")[channel]));
}

}  // namespace ir::widgets
