#include "renderers/plot/plot_data.h"

#include <algorithm>

namespace ir {

const PlotPoint* PlotData::find(const std::string& id) const {
    for (const auto& each : series)
        for (const auto& point : each.points)
            if (point.id == id) return &point;
    return nullptr;
}

int PlotData::series_of(const std::string& id) const {
    for (std::size_t s = 0; s < series.size(); ++s)
        for (const auto& point : series[s].points)
            if (point.id == id) return int(s);
    return -1;
}

std::size_t PlotData::count() const {
    std::size_t count = 0;
    for (const auto& each : series) count += each.points.size();
    return count;
}

std::vector<std::pair<const PlotPoint*, int>> PlotData::in_reading_order() const {
    std::vector<std::pair<const PlotPoint*, int>> points;
    for (std::size_t s = 0; s < series.size(); ++s)
        for (const auto& point : series[s].points) points.emplace_back(&point, int(s));
    if (are_bars)
        std::ranges::stable_sort(points, std::ranges::greater{},
                                 [](const auto& each) { return each.first->y; });
    return points;
}

}  // namespace ir
