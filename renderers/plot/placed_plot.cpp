#include "renderers/plot/placed_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "renderers/image/colour_map.h"
#include "renderers/image/luminance.h"

namespace ir {
namespace {

constexpr int tick_width = 64, tick_height = 30;  ///< logical pixels that a label wants
constexpr double farthest_level = 30;             ///< below the least value, as a factor
constexpr std::size_t marks_of_curve = 8;         ///< about

int max_ticks(double pixels, int each) {
    return std::clamp(int(pixels) / each, 3, 10);
}

bool has_place(const PlotPoint& point) {
    return !std::isnan(point.x) && !std::isnan(point.y);
}

std::vector<double> values_of(const PlotData& data, double PlotPoint::*member) {
    std::vector<double> values;
    for (const auto& series : data.series)
        for (const auto& point : series.points)
            if (has_place(point)) values.push_back(point.*member);
    return values;
}

/// Not where it would make the points' own range small.
bool is_level_near(const PlotLevel& level, const PlotAxis& axis, const std::vector<double>& heights) {
    if (!axis.log) return true;
    double lowest = std::numeric_limits<double>::infinity();
    for (const double y : heights)
        if (y > 0) lowest = std::min(lowest, y);
    return level.y > 0 && (std::isinf(lowest) || level.y * farthest_level > lowest);
}

constexpr const char* heat_colours = "viridis";

PlacedPlot::Heat heat_of(const PlotData& data) {
    PlacedPlot::Heat heat;
    bool is_first = true;
    for (const auto& series : data.series)
        for (const auto& point : series.points) {
            if (!std::isfinite(point.value)) continue;
            heat.low = is_first ? point.value : std::min(heat.low, point.value);
            heat.high = is_first ? point.value : std::max(heat.high, point.value);
            is_first = false;
        }
    heat.log = heat.low > 0 && heat.high > 10 * heat.low;
    return heat;
}

const std::array<unsigned char, 3>& entry_of(const PlacedPlot::Heat& heat, double value) {
    const auto& colours = colour_map(heat_colours);
    const auto place = [&](double v) { return heat.log ? std::log(std::max(v, heat.low)) : v; };
    const double range = place(heat.high) - place(heat.low);
    const double part = range > 0 && !std::isnan(value) ? (place(value) - place(heat.low)) / range : 0;
    return colours[static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * double(colours.size() - 1) + 0.5)];
}

void add_remark(PlacedPlot& plot, int count, const std::string& one, const std::string& many) {
    if (count > 0) plot.remarks.push_back(std::to_string(count) + (count == 1 ? one : many));
}

}  // namespace

PlotColour PlacedPlot::Heat::colour(double value) const {
    const auto& [r, g, b] = entry_of(*this, value);
    return plot_colour({std::uint8_t(r), std::uint8_t(g), std::uint8_t(b)});
}

PlotColour PlacedPlot::Heat::ink(double value) const {
    const auto& [r, g, b] = entry_of(*this, value);
    return luminance(double(r), double(g), double(b)) > 115 ? "#000000" : "#ffffff";
}

double PlacedPlot::Heat::at(double fraction) const {
    return log ? low * std::pow(high / low, fraction) : low + fraction * (high - low);
}

bool PlacedPlot::has_rings() const {
    return std::any_of(marks.begin(), marks.end(), [](const Mark& mark) { return mark.ring; });
}

PlacedPlot place_plot(const PlotData& data, double width, double height) {
    auto heights = values_of(data, &PlotPoint::y);
    const bool shows_level = data.level && is_level_near(*data.level, data.y, heights);
    if (shows_level && !heights.empty()) heights.push_back(data.level->y);
    auto widths = values_of(data, &PlotPoint::x);
    if (data.are_bars) std::ranges::copy(values_of(data, &PlotPoint::value), std::back_inserter(widths));
    const int rows = data.are_bars ? std::max(1, int(data.y.names.size())) : max_ticks(height, tick_height);
    PlacedPlot plot{PlotScale(data.x, widths, max_ticks(width, tick_width)),
                    PlotScale(data.y, heights, rows),
                    {},
                    shows_level};
    if (data.heat) plot.heat = heat_of(data);
    if (data.level && !shows_level)
        plot.remarks.push_back(data.level->label + ": " + plot_number(data.level->y) +
                               ", far below all points");
    int displaced = 0, unknown = 0;
    for (std::size_t s = 0; s < data.series.size(); ++s) {
        const auto& points = data.series[s].points;
        const std::size_t every = data.are_curves ? points.size() / marks_of_curve + 1 : 1;
        // Marks of curves that lie upon each other stand beside each other.
        const std::size_t first = every * (2 * s + 1) / (2 * data.series.size()) % every;
        bool begins = true;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto& point = points[i];
            if (!has_place(point)) {
                ++unknown;
                begins |= data.are_curves;
                continue;
            }
            const bool is_displaced = plot.x.is_displaced(point.x) || plot.y.is_displaced(point.y);
            displaced += is_displaced ? 1 : 0;
            plot.marks.push_back({point.id, int(s), i, plot.x.place(point.x), plot.y.place(point.y),
                                  point.ring, is_displaced, i % every == first, std::exchange(begins, false),
                                  data.are_bars ? plot.x.place(point.value) : point.value});
        }
    }
    add_remark(plot, displaced, " point is zero or infinite, and stands hollow at the edge",
               " points are zero or infinite, and stand hollow at the edge");
    add_remark(plot, unknown, " point has no such number", " points have no such number");
    return plot;
}

}  // namespace ir
