#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/image/comparison.h"
#include "renderers/image/metrics.h"

namespace ir {
namespace {

/// A picture looks turned where turning it lowers the error to this part …
constexpr double suspicious_error_ratio = 0.4;
/// … and the turned one is this much like the other one.
constexpr double suspicious_correlation = 0.9;
/// Below this error, in 0 … 1, pictures are equal as they are, and turning them proves nothing.
constexpr double negligible_error = 1e-4;
constexpr int smallest_side = 8;  ///< in smaller pictures few pixels decide by chance

struct Turn {
    const char* name;
    bool mirrored, upside_down;
};
constexpr Turn turns[] = {{"upside down", false, true},
                          {"mirrored from left to right", true, false},
                          {"turned by 180°", true, true}};

/// Brightness squeezed into -1 … 1, so that a few bright pixels do not decide; NaN where not finite.
std::vector<double> squeezed(const Image& image) {
    std::vector<double> values(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < values.size(); ++i) {
        double sum = 0;
        for (int c = 0; c < image.channels; ++c) sum += image.pixels[i * image.channels + c];
        values[i] = sum / (image.channels + std::abs(sum));
        if (!std::isfinite(sum)) values[i] = std::nan("");
    }
    return values;
}

struct Likeness {
    double rmse = 0, correlation = 0;
};

Likeness likeness(const std::vector<double>& a, const std::vector<double>& b, const Image& size,
                  const Turn& turn) {
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, squares = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int from_x = turn.mirrored ? size.width - 1 - x : x;
            const int from_y = turn.upside_down ? size.height - 1 - y : y;
            const double u = a[std::size_t(from_y) * size.width + from_x];
            const double v = b[std::size_t(y) * size.width + x];
            if (std::isnan(u) || std::isnan(v)) continue;
            n += 1, sa += u, sb += v, saa += u * u, sbb += v * v, sab += u * v;
            squares += (u - v) * (u - v);
        }
    if (n == 0) return {};
    const double va = saa / n - sa / n * (sa / n), vb = sbb / n - sb / n * (sb / n);
    const double covariance = sab / n - sa / n * (sb / n);
    return {std::sqrt(squares / n), va > 0 && vb > 0 ? covariance / std::sqrt(va * vb) : 0};
}

/// How the image is turned against the reference; null where it is not, or where that cannot be told.
const Turn* orientation(const Image& image, const Image& reference) {
    if (image.width < smallest_side || image.height < smallest_side) return nullptr;
    const auto a = squeezed(image), b = squeezed(reference);
    const auto as_is = likeness(a, b, image, {"", false, false});
    if (as_is.rmse < negligible_error) return nullptr;
    const Turn* best = nullptr;
    double smallest = suspicious_error_ratio * as_is.rmse;
    for (const auto& turn : turns) {
        const auto turned = likeness(a, b, image, turn);
        if (turned.rmse >= smallest || turned.correlation < suspicious_correlation) continue;
        smallest = turned.rmse;
        best = &turn;
    }
    return best;
}

}  // namespace

Comparability comparability(const Image& given, const Image& given_reference, Semantic semantic) {
    const Compared pair(given, given_reference, semantic);
    const Image &image = pair.a, &reference = pair.b;
    const auto sizes = "image " + size_text(image) + ", reference " + size_text(reference);
    if (image.width != reference.width || image.height != reference.height) {
        const bool turned = image.width == reference.height && image.height == reference.width;
        return {Misfit::size, turned ? "one picture lies on its side: " + sizes + "; turn one of them"
                                     : "sizes differ: " + sizes + "; render both at one size"};
    }
    if (image.channels != reference.channels)
        return {Misfit::channels, "channels differ: image has " + std::to_string(image.channels) +
                                      ", reference has " + std::to_string(reference.channels) +
                                      "; choose layers of one kind"};
    if (const auto* turn = orientation(image, reference))
        return {Misfit::orientation, std::string("one picture seems to be ") + turn->name +
                                         ": so it fits the other one far better; turn one of them"};
    return {};
}

std::string why_not_comparable(const Image& image, const Image& reference, Semantic semantic) {
    return comparability(image, reference, semantic).why;
}

}  // namespace ir
