#include "renderers/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderers/core/error.h"
#include "renderers/image/comparison.h"
#include "renderers/image/ssim.h"

namespace ir {
namespace {

void require_inside(const Rectangle& r, const Image& image) {
    const bool inside = r.width > 0 && r.height > 0 && r.x >= 0 && r.y >= 0 && r.x <= image.width - r.width &&
                        r.y <= image.height - r.height;
    if (!inside)
        throw UsageError("the rectangle " + std::to_string(r.x) + "," + std::to_string(r.y) + "," +
                         std::to_string(r.width) + "," + std::to_string(r.height) +
                         " (x,y,width,height) does not lie inside the image of " + size_text(image));
}

bool in_region(const MetricOptions& options, const Image& image, std::size_t pixel) {
    if (!is_valid(options.mask, pixel)) return false;
    if (!options.rectangle) return true;
    const auto& r = *options.rectangle;
    const int x = static_cast<int>(pixel % image.width), y = static_cast<int>(pixel / image.width);
    return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
}

/// Sums over channels of one pixel or of many.
struct Sums {
    double squares = 0, absolutes = 0, relative_squares = 0, differences = 0, image = 0, reference = 0;
};

void add_pixel(const Image& image, const Image& reference, std::size_t pixel, Sums& sums) {
    for (int c = 0; c < image.channels; ++c) {
        const double a = image.pixels[pixel * image.channels + c];
        const double b = reference.pixels[pixel * reference.channels + c];
        const double square = (a - b) * (a - b);
        sums.image += a;
        sums.reference += b;
        sums.differences += a - b;
        sums.squares += square;
        sums.absolutes += std::abs(a - b);
        sums.relative_squares += square / (b * b + relmse_epsilon);
    }
}

/// The pixels that count, and those that may be looked at.
struct Pixels {
    std::vector<std::size_t> compared;
    Image valid;
    double mean(const Image& map) const {
        double sum = 0;
        for (const auto pixel : compared) sum += map.pixels[pixel];
        return sum / static_cast<double>(compared.size());
    }
};

double compute(const std::string& name, const Image& image, const Image& reference, const Pixels& pixels,
               const Sums& sums, const MetricOptions& options, MetricResult& result) {
    const double count = static_cast<double>(pixels.compared.size()) * image.channels;
    if (name == "rmse") return std::sqrt(sums.squares / count);
    if (name == "mae") return sums.absolutes / count;
    if (name == "bias") return sums.differences / count;
    if (name == "relbias") return sums.differences / sums.reference;
    if (name == "mean") return sums.image / count;
    if (name == "reference-mean") return sums.reference / count;
    if (name == "relmse") return sums.relative_squares / count;
    if (name == "psnr") return -10 * std::log10(sums.squares / count);
    if (name == "ssim") return pixels.mean(ssim_map(image, reference, &pixels.valid));
    if (name == "flip") return pixels.mean(flip_error(image, reference, options.flip, &pixels.valid));
    const auto hdr = hdr_flip_error(image, reference, options.flip, &pixels.valid);
    result.exposures = FlipExposures{hdr.start, hdr.stop, hdr.exposures};
    return pixels.mean(hdr.error);
}

/// Of images whose channels are all compared.
MetricResult measure(const Image& image, const Image& reference, const std::vector<std::string>& names,
                     const MetricOptions& options) {
    require_comparable(image, reference, "image", "reference");
    require_mask_size(image, options.valid_image, "the image's mask of valid pixels");
    require_mask_size(image, options.valid_reference, "the reference's mask of valid pixels");
    require_mask_size(image, options.mask, "the mask");
    if (options.rectangle) require_inside(*options.rectangle, image);

    const auto valid = valid_in_both(image, reference, options.valid_image, options.valid_reference);
    MetricResult result;
    Pixels pixels{{}, Image(image.width, image.height, 1)};
    Sums sums;
    for (std::size_t i = 0; i < valid.size(); ++i) {
        pixels.valid.pixels[i] = valid[i];
        if (!in_region(options, image, i)) continue;
        if (!valid[i]) {
            ++result.skipped;
            continue;
        }
        pixels.compared.push_back(i);
        add_pixel(image, reference, i, sums);
    }
    result.pixels = pixels.compared.size();
    for (const auto& name : names) {
        if (options.cancel) options.cancel->check();
        result.values[name] = result.pixels ? compute(name, image, reference, pixels, sums, options, result)
                                            : std::numeric_limits<double>::quiet_NaN();
    }
    return result;
}

}  // namespace

MetricResult compute_metrics(const Image& image, const Image& reference,
                             const std::vector<std::string>& names, const MetricOptions& options) {
    for (const auto& name : names) metric(name);
    const Compared pair(image, reference, options.semantic);
    return measure(pair.a, pair.b, names, options);
}

}  // namespace ir
