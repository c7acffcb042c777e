#include <algorithm>
#include <cmath>

#include "renderers/image/colour_map.h"
#include "renderers/image/luminance.h"
#include "widgets/image/display.h"

namespace ir::widgets {
namespace {

using Rgb = std::array<unsigned char, 3>;

/// Squares of it stay finite in the shader's floats.
constexpr double brightest = 1e15;

unsigned char byte(double encoded) {
    return encoded > 0 ? static_cast<unsigned char>(std::min(encoded, 1.0) * 255 + 0.5) : 0;
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

/// Of several values the one that is farthest from 0, so that no error hides behind an opposite one.
float largest_magnitude(const float* values, int count) {
    float largest = values[0];
    for (int c = 1; c < count; ++c)
        if (std::abs(values[c]) > std::abs(largest)) largest = values[c];
    return largest;
}

Rgb scalar_colour(const Display& display, float value) {
    if (!display.categories.empty()) {
        const auto* category = category_at(&value, 1, display.categories);
        return category ? category->colour : colour_without_name;
    }
    const auto& map = colour_map(display.colour_map);
    return map[byte(fraction(display, value))];
}

/// One value is grey; of two the third component is nothing.
std::array<double, 3> components(const float* values, int count) {
    if (count == 1) return {values[0], values[0], values[0]};
    return {values[0], values[1], count > 2 ? values[2] : 0.0};
}

/// x (a x + b) / (x (c x + d) + e) with the published constants, a fit to the ACES filmic curve
/// [Narkowicz15].
double filmic(double x) {
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

Rgb light_colour(const Display& display, std::array<double, 3> light) {
    const double scale = std::exp2(display.exposure);
    for (auto& v : light) v = v > 0 ? std::min(v * scale, brightest) : 0;  // NaN, unmarked, is black
    if (display.tone_map == Display::ToneMap::reinhard) {
        const double brightness = luminance(light[0], light[1], light[2]);
        for (auto& v : light) v /= 1 + brightness;
    } else if (display.tone_map == Display::ToneMap::filmic) {
        for (auto& v : light) v = filmic(v);
    }
    const auto encoded = [](double v) {
        return byte(srgb_from_linear(static_cast<float>(std::min(v, 1.0))));
    };
    return {encoded(light[0]), encoded(light[1]), encoded(light[2])};
}

Rgb vector_colour(const Display& display, const std::array<double, 3>& values, int count) {
    const auto encoded = [&](double v) { return byte(fraction(display, v)); };
    return {encoded(values[0]), encoded(values[1]), count == 2 ? byte(0) : encoded(values[2])};
}

/// The values that a display looks at.
struct Looked {
    const float* values;
    int count;
};
Looked looked_at(const Display& display, const float* pixel, int channels) {
    if (display.channel >= 0 && display.channel < channels) return {pixel + display.channel, 1};
    return {pixel, std::min(channels, 3)};
}

}  // namespace

Rgb shade(const Display& display, const float* pixel, int channels) {
    const auto [values, count] = looked_at(display, pixel, channels);
    Rgb colour{};
    if (display.mark_bad && bad_colour(display, values, count, colour)) return colour;
    switch (display.mode) {
        case Display::Mode::colour:
            return light_colour(display, components(values, count));
        case Display::Mode::vector:
            return vector_colour(display, components(values, count), count);
        case Display::Mode::scalar:
            if (display.grey_zero && largest_magnitude(values, count) == 0) return zero_grey;
            return scalar_colour(display, largest_magnitude(values, count));
        case Display::Mode::ids:
            return id_colour(values[0]);
    }
    return colour;
}

OutOfRange out_of_range(const Display& display, const float* pixel, int channels) {
    if (display.mode == Display::Mode::ids) return OutOfRange::no;
    const auto [values, count] = looked_at(display, pixel, channels);
    Rgb mark;
    if (display.mark_bad && bad_colour(display, values, count, mark)) return OutOfRange::no;
    const bool light = display.mode == Display::Mode::colour;
    const double scale = light ? std::exp2(display.exposure) : 1;
    const double low = light ? 0 : std::min(display.low, display.high);
    const double high = light ? 1 : std::max(display.low, display.high);
    const bool scalar = display.mode == Display::Mode::scalar;
    bool below = false;
    for (int c = 0; c < (scalar ? 1 : count); ++c) {
        const double value = scale * (scalar ? largest_magnitude(values, count) : values[c]);
        if (value > high) return OutOfRange::above;
        below |= value < low;
    }
    return below ? OutOfRange::below : OutOfRange::no;
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

}  // namespace ir::widgets
