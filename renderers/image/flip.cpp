#include "renderers/image/flip.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/image/comparison.h"
#include "renderers/image/flip_colour.h"
#include "renderers/image/flip_map.h"

namespace ir {
namespace {

/// A picture as three planes, in which invalid pixels are black.
struct Planes {
    int width = 0;
    std::vector<float> channels[3];  ///< the last two are empty where the picture is grey
    const float* row(int channel, int y) const {
        const auto& plane = channels[1].empty() ? channels[0] : channels[channel];
        return &plane[std::size_t(y) * width];
    }
};

flip::Rgb colour(const Planes& planes, std::size_t pixel) {
    const bool grey = planes.channels[1].empty();
    return {planes.channels[0][pixel], planes.channels[grey ? 0 : 1][pixel],
            planes.channels[grey ? 0 : 2][pixel]};
}

using Valid = std::vector<unsigned char>;

Planes planes_of(const Image& image, const Valid& valid) {
    Planes planes{image.width, {}};
    for (int c = 0; c < image.channels; ++c) {
        planes.channels[c].resize(valid.size());
        for (std::size_t i = 0; i < valid.size(); ++i)
            planes.channels[c][i] = valid[i] ? std::max(image.pixels[i * image.channels + c], 0.0f) : 0;
    }
    return planes;
}

Valid checked(const Image& image, const Image& reference, const Image* valid) {
    require_comparable(image, reference, "image", "reference");
    require_mask_size(image, valid, "the mask of valid pixels");
    if (image.channels != 1 && image.channels != 3)
        throw UsageError("ꟻLIP compares colours or greys, not " + std::to_string(image.channels) +
                         " channels; choose a layer of colours or greys");
    return valid_in_both(image, reference, valid, nullptr);
}

flip::Map map_for(const Image& image, const FlipOptions& options) {
    if (!(options.pixels_per_degree >= 1 && options.pixels_per_degree <= 1000))
        throw UsageError("pixels per degree are " + std::to_string(options.pixels_per_degree) +
                         "; give 1 to 1000 (a desktop screen has about 67)");
    return {image.width, image.height, options.pixels_per_degree};
}

IR_WIDE_REGISTERS void clip_row(const float* in, float* out, int width) {
    for (int x = 0; x < width; ++x) out[x] = flip::clipped(in[x]);
}

/// What a screen shows of a linear picture.
flip::RowSource clipped_rows(const Planes& planes) {
    return [&planes](int y, float* red, float* green, float* blue) {
        float* out[3] = {red, green, blue};
        for (int c = 0; c < 3; ++c) clip_row(planes.row(c, y), out[c], planes.width);
    };
}

/// Narkowicz' fit of the ACES film curve, (a x² + b x) / (c x² + d x + e), with the exposure of 0.6 that he
/// leaves out [Andersson21 §4].
namespace aces {
constexpr double a = 0.6 * 0.6 * 2.51, b = 0.6 * 0.03, c = 0.6 * 0.6 * 2.43, d = 0.6 * 0.59, e = 0.14;

float tone_mapped(float x) {
    constexpr float largest = 1e8f;  // squares of larger ones overflow; the curve is flat by then
    x = std::min(x, largest);
    return x * (float(a) * x + float(b)) / (x * (float(c) * x + float(d)) + float(e));
}

/// The positive x that the curve maps to y.
double inverse(double y) {
    const double A = a - y * c, B = b - y * d, C = -y * e;
    return (-B + std::sqrt(B * B - 4 * A * C)) / (2 * A);
}
}  // namespace aces

IR_WIDE_REGISTERS void tone_map_row(const float* in, float factor, float* out, int width) {
    for (int x = 0; x < width; ++x) out[x] = flip::clipped(aces::tone_mapped(factor * in[x]));
}

/// Finite even for pictures of denormal numbers: infinity times black would be no number.
float exposure_factor(double exposure) {
    return static_cast<float>(std::exp2(std::clamp(exposure, -126.0, 127.0)));
}

flip::RowSource tone_mapped_rows(const Planes& planes, double exposure) {
    return [&planes, factor = exposure_factor(exposure)](int y, float* red, float* green, float* blue) {
        float* out[3] = {red, green, blue};
        for (int c = 0; c < 3; ++c) tone_map_row(planes.row(c, y), factor, out[c], planes.width);
    };
}

/// The largest and the median luminance of valid pixels; both 0 where all is black.
struct Luminances {
    float median = 0, largest = 0;
};

float median(std::vector<float>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Luminances luminances(const Planes& planes, const Valid& valid) {
    std::vector<float> all;
    for (std::size_t i = 0; i < valid.size(); ++i)
        if (valid[i]) all.push_back(flip::luminance(colour(planes, i)));
    if (all.empty()) return {};
    Luminances result{median(all), *std::max_element(all.begin(), all.end())};
    if (result.median > 0 || result.largest <= 0) return result;
    // DEVIATION [Andersson21 §4]: a black median has no exposure that makes it visible. What is lit counts.
    std::erase_if(all, [](float value) { return value <= 0; });
    result.median = median(all);
    return result;
}

FlipExposures exposures_of(const Planes& image, const Planes& reference, const Valid& valid) {
    auto range = luminances(reference, valid);
    if (range.largest <= 0) range = luminances(image, valid);
    if (range.largest <= 0) return {};
    constexpr double nearly_white = 0.85;  // [Andersson21 §4]
    const double white = aces::inverse(nearly_white);
    FlipExposures result{std::log2(white / range.largest), std::log2(white / range.median), 2};
    const double stops = std::ceil(result.stop - result.start);
    result.count = static_cast<int>(std::clamp(stops, 2.0, double(max_flip_exposures)));
    return result;
}

}  // namespace

Image flip_error(const Image& image, const Image& reference, const FlipOptions& options, const Image* valid) {
    const auto usable = checked(image, reference, valid);
    auto map = map_for(image, options);
    const auto a = planes_of(image, usable), b = planes_of(reference, usable);
    Image result(image.width, image.height, 1);
    result.pixels = map.compute(clipped_rows(a), clipped_rows(b));
    return result;
}

FlipExposures flip_exposures(const Image& image, const Image& reference, const Image* valid) {
    const auto usable = checked(image, reference, valid);
    return exposures_of(planes_of(image, usable), planes_of(reference, usable), usable);
}

HdrFlipResult hdr_flip_error(const Image& image, const Image& reference, const FlipOptions& options,
                             const Image* valid) {
    const auto usable = checked(image, reference, valid);
    auto map = map_for(image, options);
    const auto a = planes_of(image, usable), b = planes_of(reference, usable);
    const auto exposures = exposures_of(a, b, usable);
    HdrFlipResult result{Image(image.width, image.height, 1), exposures.start, exposures.stop,
                         exposures.count, Image(image.width, image.height, 1)};
    for (int i = 0; i < exposures.count; ++i) {
        const double exposure = exposures.at(i);
        const auto& error = map.compute(tone_mapped_rows(a, exposure), tone_mapped_rows(b, exposure));
        for (std::size_t p = 0; p < error.size(); ++p)
            if (error[p] > result.error.pixels[p]) {
                result.error.pixels[p] = error[p];
                result.exposure_map.pixels[p] = static_cast<float>(i);
            }
    }
    return result;
}

}  // namespace ir
