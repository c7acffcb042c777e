#include "app/engine/analysis/bars.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "renderers/plot/plot_scale.h"

namespace ir::engine {

Bars::Bars(const std::string& title, const std::string& x_title, std::vector<std::string> headings,
           const std::vector<std::string>& series) {
    data_.are_bars = true;
    data_.title = title;
    data_.x.title = x_title;
    data_.headings = std::move(headings);
    for (const auto& name : series) data_.series.push_back({name, {}});
}

void Bars::begin_row(const std::string& name) {
    data_.y.names.push_back(name);
}

PlotPoint& Bars::add(const std::string& id, double from, double to, std::vector<PlotCell> cells, int series) {
    PlotPoint point;
    point.id = id;
    point.x = to;
    point.y = double(data_.y.names.size()) - 1;
    point.value = from;
    for (std::size_t i = 0; i < cells.size(); ++i)
        point.label += (i == 0 ? "" : "\n" + data_.headings.at(i) + " ") + cells[i].text;
    point.cells = std::move(cells);
    return data_.series.at(std::size_t(series)).points.emplace_back(std::move(point));
}

PlotData Bars::finish(const std::vector<std::string>& notes) && {
    const double last = double(data_.y.names.size()) - 1;
    std::ranges::reverse(data_.y.names);  // the axis begins at the bottom
    for (auto& series : data_.series)
        for (auto& point : series.points) point.y = last - point.y;
    data_.notes = notes;
    return std::move(data_);
}

PlotCell number_cell(double value) {
    return {plot_number(value), value};
}

PlotCell percent_cell(double part) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100 * part);
    return {text, part};
}

PlotCell change_cell(double value) {
    return {(value > 0 ? "+" : "") + plot_number(value), value};
}

}  // namespace ir::engine
