#pragma once

#include <vector>

#include "renderers/plot/plot_data.h"

namespace ir {

/// Where values stand along an axis: the values themselves, or their decimal logarithms. A value that has no
/// place (zero on a logarithmic axis, infinity) stands at the end that it lies beyond.
class PlotScale {
  public:
    struct Tick {
        double place = 0;
        std::string text;
    };
    /// Of an axis that is to show these values; NaN has no place. At most `max_ticks` round numbers.
    PlotScale(const PlotAxis& axis, const std::vector<double>& values, int max_ticks = 8);

    double low() const { return low_; }
    double high() const { return high_; }
    /// Within low() … high() for every value that was given, but NaN for NaN.
    double place(double value) const;
    /// Whether the value stands at an end because it has no place.
    bool is_displaced(double value) const;
    const std::vector<Tick>& ticks() const { return ticks_; }

  private:
    double raw(double value) const;
    void fit(const std::vector<double>& values);
    void name_all(const std::vector<std::string>& names, int max_labels);
    void label_wanted(const std::vector<double>& wanted, int max_labels);
    void label_linear(int max_labels);
    void label_log(int max_labels);

    bool log_;
    double low_ = 0, high_ = 1;
    std::vector<Tick> ticks_;
};

/// "0.02", "1500", "2·10⁻⁵": three digits that count.
std::string plot_number(double value);

}  // namespace ir
