#include "renderers/plot/plot_data.h"

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

}  // namespace ir
