#include "renderers/image/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ir::flip {
namespace {

using std::numbers::pi;

/// Standard deviations that a filter reaches out.
constexpr double reach = 3;

/// A term a √(π/b) exp(-π² x² / b) of a contrast sensitivity, x in degrees [Andersson20 table 1].
struct Term {
    double a, b;
};
constexpr Term luminance_term{1, 0.0047}, red_green_term{1, 0.0053};
constexpr Term blue_yellow_terms[2] = {{34.1, 0.04}, {13.5, 0.025}};

/// Standard deviation of the feature detectors: half the width of 0.082° at which the eye finds edges
/// strongest [Andersson20 §4.2].
constexpr double feature_deviation_degrees = 0.5 * 0.082;

int radius_of(double deviation_px) {
    return static_cast<int>(std::ceil(reach * deviation_px));
}

/// All contrast filters reach as far as the widest one does.
int contrast_radius(double pixels_per_degree) {
    const double widest = std::max({luminance_term.b, red_green_term.b, blue_yellow_terms[0].b});
    return radius_of(std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree);
}

std::vector<double> sample(int radius, const std::function<double(double)>& at_pixel) {
    std::vector<double> values;
    for (int i = -radius; i <= radius; ++i) values.push_back(at_pixel(i));
    return values;
}

double sum(const std::vector<double>& values) {
    double total = 0;
    for (const double value : values) total += value;
    return total;
}

/// Without the outermost weights that no float result would feel.
Taps taps(std::vector<double> weights) {
    constexpr double negligible = 1e-9;
    double largest = 0;
    for (const double weight : weights) largest = std::max(largest, std::abs(weight));
    while (weights.size() > 1 && std::abs(weights.front()) < negligible * largest &&
           std::abs(weights.back()) < negligible * largest) {
        weights.erase(weights.begin());
        weights.pop_back();
    }
    return {static_cast<int>(weights.size() / 2), {weights.begin(), weights.end()}};
}

Taps scaled(std::vector<double> weights, double factor) {
    for (double& weight : weights) weight *= factor;
    return taps(std::move(weights));
}

/// Positive weights add up to 1, negative ones to -1.
Taps balanced(std::vector<double> weights) {
    double positive = 0, negative = 0;
    for (const double weight : weights) (weight > 0 ? positive : negative) += std::abs(weight);
    for (double& weight : weights)
        if (const double total = weight > 0 ? positive : negative; total > 0) weight /= total;
    return taps(std::move(weights));
}

}  // namespace

ContrastSensitivity contrast_sensitivity(double pixels_per_degree) {
    const int radius = contrast_radius(pixels_per_degree);
    const auto bell = [&](const Term& term, double scale) {
        return sample(radius, [&](double px) {
            const double x = px / pixels_per_degree;
            return scale * std::exp(-pi * pi * x * x / term.b);
        });
    };
    ContrastSensitivity result;
    const auto luminance = bell(luminance_term, 1), red_green = bell(red_green_term, 1);
    result.luminance = scaled(luminance, 1 / sum(luminance));
    result.red_green = scaled(red_green, 1 / sum(red_green));
    std::vector<double> parts[2];
    double total = 0;  // of the 2D filter
    for (int i = 0; i < 2; ++i) {
        const auto& term = blue_yellow_terms[i];
        parts[i] = bell(term, std::sqrt(term.a * std::sqrt(pi / term.b)));
        total += sum(parts[i]) * sum(parts[i]);
    }
    for (int i = 0; i < 2; ++i) result.blue_yellow[i] = scaled(parts[i], 1 / std::sqrt(total));
    return result;
}

FeatureDetectors feature_detectors(double pixels_per_degree) {
    const double deviation = feature_deviation_degrees * pixels_per_degree;
    const int radius = radius_of(deviation);
    const auto gauss = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    FeatureDetectors result;
    const auto smooth = sample(radius, gauss);
    result.smooth = scaled(smooth, 1 / sum(smooth));
    result.edge = balanced(sample(radius, [&](double x) { return -x * gauss(x); }));
    result.point =
        balanced(sample(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
    return result;
}

int largest_radius(double pixels_per_degree) {
    return std::max(contrast_radius(pixels_per_degree),
                    radius_of(feature_deviation_degrees * pixels_per_degree));
}

}  // namespace ir::flip
