#include "renderers/plot/line_profile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "renderers/core/value.h"
#include "renderers/core/words.h"

namespace ir {
namespace {

std::vector<LineProfile::Place> places_of(const PixelLine& line) {
    const int dx = line.x2 - line.x1, dy = line.y2 - line.y1;
    const int steps = std::max(std::abs(dx), std::abs(dy));
    std::vector<LineProfile::Place> places;
    for (int i = 0; i <= steps; ++i) {
        const double part = steps > 0 ? double(i) / steps : 0;
        places.push_back({line.x1 + int(std::lround(part * dx)), line.y1 + int(std::lround(part * dy)),
                          part * std::hypot(dx, dy)});
    }
    return places;
}

}  // namespace

LineProfile line_profile(const std::vector<MeasuredImage>& images, const PixelLine& line, int choice) {
    LineProfile profile{places_of(line), {}};
    for (const auto& each : images)
        for (const auto& number : pixel_numbers(each.semantic, each.image->channels, choice)) {
            LineProfile::Curve curve{number.name.empty() ? each.label : each.label + "  " + number.name, {}};
            for (const auto& place : profile.places)
                curve.values.push_back(
                    each.has_value(place.x, place.y)
                        ? number.of(&each.image->pixels[each.image->index(place.x, place.y)])
                        : std::numeric_limits<double>::quiet_NaN());
            profile.curves.push_back(std::move(curve));
        }
    return profile;
}

PlotData plot_of(const LineProfile& profile, const std::string& value_title) {
    PlotData plot;
    plot.x.title = "Distance along the line (pixels)";
    plot.y.title = value_title;
    plot.are_curves = true;
    for (std::size_t c = 0; c < profile.curves.size(); ++c) {
        const auto& curve = profile.curves[c];
        PlotSeries series{curve.name, {}};
        for (std::size_t i = 0; i < profile.places.size(); ++i) {
            const auto& place = profile.places[i];
            series.points.push_back({.id = std::to_string(c) + ":" + std::to_string(i),
                                     .x = place.distance,
                                     .y = curve.values[i],
                                     .label = curve.name + "\nx " + std::to_string(place.x) + "  y " +
                                              std::to_string(place.y) + "\n" +
                                              shortest_text(float(curve.values[i])),
                                     .cells = {}});
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

std::string profile_csv(const LineProfile& profile) {
    std::string text = "x,y,distance";
    for (const auto& curve : profile.curves) text += "," + csv_field(curve.name);
    for (std::size_t i = 0; i < profile.places.size(); ++i) {
        const auto& place = profile.places[i];
        text += "\n" + std::to_string(place.x) + "," + std::to_string(place.y) + "," +
                shortest_text(float(place.distance));
        for (const auto& curve : profile.curves)
            text += "," + (std::isnan(curve.values[i]) ? "" : shortest_text(float(curve.values[i])));
    }
    return text + "\n";
}

}  // namespace ir
