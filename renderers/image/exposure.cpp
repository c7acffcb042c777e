#include "renderers/image/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderers/image/luminance.h"

namespace ir {
namespace {

constexpr double middle_grey = 0.18;
/// Parts of the lit pixels that may be clipped at most, and that may stay below near_white at most.
constexpr double max_clipped = 1 / 7.0, brightest = 0.01, near_white = 0.7;
/// Enough to know a percentile by.
constexpr std::size_t max_samples = 100'000;

}  // namespace

double automatic_exposure(const Image& image) {
    if (image.empty()) return 0;
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto channels = static_cast<std::size_t>(image.channels);
    const auto step = std::max<std::size_t>(1, pixels / max_samples);
    std::vector<double> stops;  // log2 of luminance
    double sum = 0;
    for (std::size_t i = 0; i < pixels; i += step) {
        const float* p = &image.pixels[i * channels];
        const double luminance = channels < 3 ? p[0] : ir::luminance<double>(p[0], p[1], p[2]);
        if (!(luminance > 0) || !std::isfinite(luminance)) continue;
        stops.push_back(std::log2(luminance));
        sum += stops.back();
    }
    if (stops.empty()) return 0;
    const auto percentile = [&](double from_top) {
        const auto at = stops.begin() +
                        static_cast<std::ptrdiff_t>((1 - from_top) * static_cast<double>(stops.size() - 1));
        std::nth_element(stops.begin(), at, stops.end());
        return *at;
    };
    const double grey = std::log2(middle_grey) - sum / static_cast<double>(stops.size());
    const double most = -percentile(max_clipped), least = std::log2(near_white) - percentile(brightest);
    const double exposure = std::clamp(grey, std::min(least, most), most);
    return std::clamp(std::round(exposure * 4) / 4, -40.0, 40.0) + 0.0;
}

}  // namespace ir
