#include "renderers/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"

namespace ir {
namespace {

/// Alpha is coverage, not a measured quantity.
int compared_channels(const Image& image) {
    return image.channels == 4 ? 3 : image.channels;
}

std::string size_text(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void require_comparable(const Image& image, const Image& reference) {
    if (image.width != reference.width || image.height != reference.height)
        throw UsageError("sizes differ: image " + size_text(image) + ", reference " + size_text(reference) +
                         "; render both at one size");
    if (compared_channels(image) != compared_channels(reference))
        throw UsageError("channels differ: image has " + std::to_string(image.channels) + ", reference has " +
                         std::to_string(reference.channels) + "; choose layers of one kind");
}

void require_mask_size(const Image& image, const Image* mask, const char* name) {
    if (!mask) return;
    if (mask->width != image.width || mask->height != image.height || mask->channels != 1)
        throw UsageError(std::string("sizes differ: ") + name + " " + size_text(*mask) + " with " +
                         std::to_string(mask->channels) + " channels, image " + size_text(image) +
                         "; a mask has the image's size and one channel");
}

bool is_valid(const Image* mask, int x, int y) {
    return !mask || mask->at(x, y) > 0.5f;
}

struct Sums {
    double squares = 0, absolutes = 0;
    std::size_t pixels = 0, skipped = 0;
};

/// Adds one pixel, unless a channel is NaN or infinite in either image.
bool add_pixel(const Image& image, const Image& reference, int x, int y, int channels, Sums& sums) {
    double squares = 0, absolutes = 0;
    for (int c = 0; c < channels; ++c) {
        const double a = image.at(x, y, c), b = reference.at(x, y, c);
        if (!std::isfinite(a) || !std::isfinite(b)) return false;
        squares += (a - b) * (a - b);
        absolutes += std::abs(a - b);
    }
    sums.squares += squares;
    sums.absolutes += absolutes;
    return true;
}

double metric_value(const std::string& name, const Sums& sums, int channels) {
    const double count = static_cast<double>(sums.pixels) * channels;
    if (name == "mae") return sums.absolutes / count;
    const double mse = sums.squares / count;
    if (name == "rmse") return std::sqrt(mse);
    return -10 * std::log10(mse);  // psnr with a peak of 1
}

}  // namespace

const std::vector<std::string>& metric_names() {
    static const std::vector<std::string> names = {"rmse", "mae", "psnr"};
    return names;
}

MetricResult compute_metrics(const Image& image, const Image& reference,
                             const std::vector<std::string>& metrics, const Image* mask_a,
                             const Image* mask_b) {
    for (const auto& name : metrics)
        if (std::find(metric_names().begin(), metric_names().end(), name) == metric_names().end())
            throw UsageError("unknown metric '" + name + "'; known are rmse, mae, psnr");
    require_comparable(image, reference);
    require_mask_size(image, mask_a, "the image's mask");
    require_mask_size(image, mask_b, "the reference's mask");

    const int channels = compared_channels(image);
    Sums sums;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const bool added = is_valid(mask_a, x, y) && is_valid(mask_b, x, y) &&
                               add_pixel(image, reference, x, y, channels, sums);
            ++(added ? sums.pixels : sums.skipped);
        }
    MetricResult result;
    result.pixels = sums.pixels;
    result.skipped = sums.skipped;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const auto& name : metrics)
        result.values[name] = sums.pixels ? metric_value(name, sums, channels) : none;
    return result;
}

Image signed_difference(const Image& image, const Image& reference) {
    require_comparable(image, reference);
    Image result(image.width, image.height, compared_channels(image));
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x)
            for (int c = 0; c < result.channels; ++c)
                result.at(x, y, c) = image.at(x, y, c) - reference.at(x, y, c);
    return result;
}

}  // namespace ir
