#include "renderers/image/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderers/image/comparison.h"

namespace ir {
namespace {

/// Probability of |T| ≤ t, the finite series for whole degrees [Abramowitz64 26.7.3, 26.7.4].
double student_inside(double t, int degrees) {
    const double angle = std::atan(t / std::sqrt(double(degrees)));
    const double cosine = std::cos(angle), square = cosine * cosine;
    const bool odd = degrees % 2 == 1;
    double term = odd ? cosine : 1, sum = degrees == 1 ? 0 : term;
    for (int i = odd ? 3 : 2; i < degrees; i += 2) sum += term *= square * (i - 1) / i;
    return odd ? 2 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

/// Sum of the variances of both pictures' means at a pixel.
double variance_at(const std::vector<const Image*>& variances, std::size_t pixel, int channel) {
    double sum = 0;
    for (const auto* variance : variances)
        sum += variance->pixels[pixel * variance->channels + std::min(channel, variance->channels - 1)];
    return sum;
}

/// The mean over the window with the pixel in its corner, towards (sx, sy).
struct Pool {
    double mean = 0;
    int count = 0;
};
Pool pool(const std::vector<double>& variance, int width, int height, int x, int y, int sx, int sy) {
    Pool result;
    for (int j = 0; j <= noise_pool_radius; ++j)
        for (int i = 0; i <= noise_pool_radius; ++i) {
            const int u = x + sx * i, v = y + sy * j;
            if (u < 0 || v < 0 || u >= width || v >= height) continue;
            const double value = variance[std::size_t(v) * width + u];
            if (std::isnan(value)) continue;
            result.mean += value;
            ++result.count;
        }
    if (result.count) result.mean /= result.count;
    return result;
}

}  // namespace

double student_quantile(double alpha, int degrees) {
    double low = 0, high = 1;
    while (1 - student_inside(high, degrees) > alpha) high *= 2;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (1 - student_inside(middle, degrees) > alpha ? low : high) = middle;
    }
    return high;
}

std::vector<float> noise_threshold(const std::vector<const Image*>& variances, int channel, double alpha,
                                   int degrees, const std::vector<unsigned char>& valid) {
    const int width = variances.front()->width, height = variances.front()->height;
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> variance(valid.size());
    for (std::size_t i = 0; i < valid.size(); ++i) {
        const double own = valid[i] ? variance_at(variances, i, channel) : unknown;
        variance[i] = own >= 0 && std::isfinite(own) ? own : unknown;
    }
    constexpr int window = (noise_pool_radius + 1) * (noise_pool_radius + 1);
    std::array<double, window + 1> quantiles{};
    for (int n = 1; n <= window; ++n) quantiles[n] = student_quantile(alpha, n * degrees);

    std::vector<float> threshold(valid.size());
    for_each_row(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel = std::size_t(y) * width + x;
            double largest = variance[pixel];
            int most = 1;
            for (const int sx : {-1, 1})
                for (const int sy : {-1, 1}) {
                    const auto part = pool(variance, width, height, x, y, sx, sy);
                    largest = std::max(largest, part.mean);
                    most = std::max(most, part.count);
                }
            threshold[pixel] = std::isnan(variance[pixel])
                                   ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(quantiles[most] * std::sqrt(largest));
        }
    });
    return threshold;
}

}  // namespace ir
