#include "renderers/plot/plot_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ir {
namespace {

constexpr double range_margin = 0.05;  ///< of the range, beside the outermost points
constexpr double min_decades = 0.1;

std::string superscript(int exponent) {
    static const std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(exponent))) text += digits[std::size_t(digit - '0')];
    return text;
}

std::string printed(const char* format, int digits, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, digits, value);
    return text;
}

/// 1, 2 or 5 times a power of ten, such that `range` has at most `most` of them.
double round_step(double range, int max_labels) {
    const double min_step = range / max_labels;
    const double power = std::pow(10.0, std::floor(std::log10(min_step)));
    for (const double mantissa : {1.0, 2.0, 5.0})
        if (mantissa * power >= min_step * (1 - 1e-9)) return mantissa * power;
    return 10 * power;
}

}  // namespace

std::string plot_number(double value) {
    if (!std::isfinite(value)) return std::isnan(value) ? "—" : value > 0 ? "∞" : "−∞";
    const double size = std::abs(value);
    if (size == 0) return "0";
    if (size >= 1e-3 && size < 1e6) {
        auto text = printed("%.*f", std::max(0, 2 - int(std::floor(std::log10(size)))), value);
        if (text.find('.') != std::string::npos) {
            text.resize(text.find_last_not_of('0') + 1);
            if (text.back() == '.') text.pop_back();
        }
        return text;
    }
    int exponent = int(std::floor(std::log10(size)));
    auto mantissa = printed("%.*g", 3, value / std::pow(10.0, exponent));
    if (mantissa == "10") mantissa = "1", ++exponent;
    const auto power = "10" + superscript(exponent);
    return mantissa == "1" ? power : mantissa + "·" + power;
}

PlotScale::PlotScale(const PlotAxis& axis, const std::vector<double>& values, int max_ticks)
    : log_(axis.log && axis.names.empty()) {
    if (!axis.names.empty()) {
        name_all(axis.names, max_ticks);
        return;
    }
    fit(values);
    label_wanted(axis.wanted, max_ticks);
    if (ticks_.empty()) log_ ? label_log(max_ticks) : label_linear(max_ticks);
}

double PlotScale::raw(double value) const {
    return log_ ? std::log10(value) : value;
}

bool PlotScale::is_displaced(double value) const {
    return std::isinf(value) || (log_ && value <= 0);
}

double PlotScale::place(double value) const {
    if (std::isnan(value)) return value;
    if (log_ && value <= 0) return low_;
    if (std::isinf(value)) return value > 0 ? high_ : low_;
    return raw(value);
}

void PlotScale::fit(const std::vector<double>& values) {
    bool any = false, displaced = false;
    for (const double value : values) {
        if (std::isnan(value)) continue;
        if (is_displaced(value)) {
            displaced = true;
            continue;
        }
        low_ = any ? std::min(low_, raw(value)) : raw(value);
        high_ = any ? std::max(high_, raw(value)) : raw(value);
        any = true;
    }
    if (!any) {
        low_ = log_ ? -2 : 0;
        high_ = log_ ? 0 : 1;
        return;
    }
    // A single value stands in the middle; what has no place stands apart from all that have one.
    const double min_range = log_ ? min_decades : std::max(1e-12, 0.1 * std::abs(high_));
    const double range = std::max(high_ - low_, min_range);
    const double middle = (low_ + high_) / 2, half = range * (0.5 + (displaced ? 3 : 1) * range_margin);
    const bool from_zero = !log_ && low_ >= 0 && low_ < 0.35 * high_;
    low_ = from_zero ? 0 : middle - half;
    high_ = middle + half;
}

void PlotScale::name_all(const std::vector<std::string>& names, int max_labels) {
    low_ = -0.5;
    high_ = double(names.size()) - 0.5;
    const auto most = static_cast<std::size_t>(max_labels);
    const auto step = std::max<std::size_t>(1, (names.size() + most - 1) / most);
    for (std::size_t i = 0; i < names.size(); i += step) ticks_.push_back({double(i), names[i]});
}

/// Only where they are few, and far enough apart to be read.
void PlotScale::label_wanted(const std::vector<double>& wanted, int max_labels) {
    if (int(wanted.size()) > max_labels) return;
    std::vector<double> sorted = wanted;
    std::sort(sorted.begin(), sorted.end());
    for (const double value : sorted) {
        if (std::isnan(value) || is_displaced(value)) continue;
        const double at = raw(value);
        if (!ticks_.empty() && at - ticks_.back().place < 0.06 * (high_ - low_)) continue;
        ticks_.push_back({at, plot_number(value)});
    }
}

void PlotScale::label_linear(int max_labels) {
    const double step = round_step(high_ - low_, max_labels);
    for (double i = std::ceil(low_ / step - 1e-9); i * step <= high_ + 1e-9 * step; ++i)
        ticks_.push_back({i * step, plot_number(i * step)});
}

/// 1, 2, 5 in each decade where that is enough, all digits where it is not, powers alone where it is too
/// much.
void PlotScale::label_log(int max_labels) {
    const std::vector<std::vector<double>> sets = {{1, 2, 3, 4, 5, 6, 7, 8, 9}, {1, 2, 5}, {1}};
    for (const auto& set : sets) {
        std::vector<Tick> ticks;
        for (int decade = int(std::floor(low_)); decade <= int(std::ceil(high_)); ++decade)
            for (const double mantissa : set) {
                const double value = mantissa * std::pow(10.0, decade);
                const double at = std::log10(value);
                if (at >= low_ - 1e-9 && at <= high_ + 1e-9) ticks.push_back({at, plot_number(value)});
            }
        ticks_ = std::move(ticks);
        if (int(ticks_.size()) <= max_labels) break;
    }
    if (int(ticks_.size()) > max_labels) {
        const auto step = (ticks_.size() + std::size_t(max_labels) - 1) / std::size_t(max_labels);
        std::vector<Tick> fewer;
        for (std::size_t i = 0; i < ticks_.size(); i += step) fewer.push_back(ticks_[i]);
        ticks_ = std::move(fewer);
    }
    if (ticks_.size() >= 3) return;
    ticks_.clear();  // less than a decade: round numbers at even distances of the values
    const double first = std::pow(10.0, low_), last = std::pow(10.0, high_);
    const double step = round_step(last - first, std::max(2, max_labels - 2));
    for (double i = std::ceil(first / step - 1e-9); i * step <= last * (1 + 1e-9); ++i)
        if (i * step > 0) ticks_.push_back({std::log10(i * step), plot_number(i * step)});
}

}  // namespace ir
