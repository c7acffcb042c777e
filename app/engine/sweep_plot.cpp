#include "app/engine/sweep_plot.h"

#include <algorithm>
#include <map>
#include <set>

#include "app/engine/study_plot.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_scale.h"

namespace ir::engine {
namespace {

using projects::Json;

const std::string time_key = "time", memory_key = "memory";

std::string heading_of(const SweepTable& table, const std::string& quantity) {
    for (const auto& each : quantities_of(table))
        if (each.key == quantity) return each.heading;
    return quantity;
}

std::string other_axes(const SweepRow& row, const std::string& axis) {
    SweepRow others = row;
    others.coordinates.erase(axis);
    return others.coordinates.empty() ? "" : name_of(others);
}

std::string label_of(const SweepRow& row, const std::string& heading, double value) {
    return name_of(row) + "\n" + plot_number(time_of(row)) + " ms\n" + heading + " " + plot_number(value);
}

/// Ids of rows that no other is both faster and better than.
std::set<std::string> front_of(const SweepTable& table, const std::string& metric) {
    std::vector<ErrorPoint> points;
    for (const auto& row : table.rows) {
        if (!row.is_done() || !row.errors.count(metric)) continue;
        ErrorPoint point;
        point.experiment = row.id;
        point.ms = time_of(row);
        point.errors = row.errors;
        points.push_back(std::move(point));
    }
    std::set<std::string> front;
    if (points.empty()) return front;
    mark_front(points, metric);
    for (const auto& point : points)
        if (point.on_front) front.insert(point.experiment);
    return front;
}

/// The values of an axis in the sweep's order.
std::vector<std::string> values_along(const SweepTable& table, const std::string& axis) {
    std::vector<std::string> values;
    std::set<std::string> known;
    for (const auto& row : table.rows)
        if (const auto text = value_text(row.coordinates.value(axis, Json())); known.insert(text).second)
            values.push_back(text);
    return values;
}

}  // namespace

std::vector<std::string> axes_of(const SweepTable& table) {
    std::vector<std::string> axes;
    for (const auto& row : table.rows)
        for (const auto& [key, value] : row.coordinates.items())
            if (std::find(axes.begin(), axes.end(), key) == axes.end()) axes.push_back(key);
    return axes;
}

std::vector<std::string> number_axes_of(const SweepTable& table) {
    std::vector<std::string> found;
    for (const auto& axis : axes_of(table)) {
        std::set<std::string> values;
        bool is_number = true;
        for (const auto& row : table.rows) {
            const auto& value = row.coordinates.value(axis, Json());
            values.insert(value.dump());
            is_number = is_number && value.is_number();
        }
        if (is_number && values.size() > 1) found.push_back(axis);
    }
    return found;
}

std::string name_of(const SweepRow& row) {
    std::string name;
    for (const auto& [key, value] : row.coordinates.items())
        name += (name.empty() ? "" : ", ") + key + " = " + value_text(value);
    return name.empty() ? row.id : name;
}

double time_of(const SweepRow& row) {
    return row.warm_ms.value_or(row.cold_ms);
}

std::vector<std::string> measured_metrics(const SweepTable& table) {
    std::vector<std::string> names;
    for (const auto& name : metric_names())
        if (std::any_of(table.rows.begin(), table.rows.end(),
                        [&](const SweepRow& row) { return row.errors.count(name) != 0; }))
            names.push_back(name);
    return names;
}

std::vector<SweepQuantity> quantities_of(const SweepTable& table) {
    std::vector<SweepQuantity> found;
    for (const auto& name : measured_metrics(table)) found.push_back({name, metric_heading(name)});
    found.push_back({time_key, "Time of rendering (ms)"});
    found.push_back({memory_key, "Memory (MiB)"});
    return found;
}

std::optional<double> value_of(const SweepRow& row, const std::string& quantity) {
    if (!row.is_done()) return {};
    if (quantity == time_key) return time_of(row);
    if (quantity == memory_key) return double(row.memory_bytes) / (1 << 20);
    const auto found = row.errors.find(quantity);
    return found == row.errors.end() ? std::nullopt : std::optional(found->second);
}

PlotData sweep_plot(const SweepTable& table, const std::string& over, const std::string& quantity) {
    const auto heading = heading_of(table, quantity);
    const auto front = over.empty() ? front_of(table, quantity) : std::set<std::string>();
    const auto axes = axes_of(table);
    const auto along = over.empty() && !axes.empty() ? axes.back() : over;
    PlotData data;
    data.title = heading + (over.empty() ? " over time" : " over " + over);
    data.y.title = heading;
    data.x.title = over.empty() ? "Time of rendering (ms)" : over;
    bool has_log_x = true, has_log_y = true;
    std::map<std::string, std::size_t> series;
    for (const auto& row : table.rows) {
        const auto value = value_of(row, quantity);
        if (!value) continue;
        PlotPoint at;
        at.id = row.id;
        at.x = over.empty() ? time_of(row) : row.coordinates.at(over).get<double>();
        at.y = *value;
        at.ring = front.count(row.id) != 0;
        at.label = label_of(row, heading, at.y);
        has_log_x = has_log_x && at.x > 0;
        has_log_y = has_log_y && at.y >= 0;
        const auto name = other_axes(row, along);
        const auto [found, is_new] = series.emplace(name, data.series.size());
        if (is_new) data.series.push_back({name.empty() ? table.experiment : name, {}});
        data.series[found->second].points.push_back(std::move(at));
    }
    data.x.log = has_log_x;
    data.y.log = has_log_y;
    data.ring_name = "front: no other is faster and better";
    data.join_rings = over.empty();
    return data;
}

PlotData sweep_heat(const SweepTable& table, const std::string& x, const std::string& y,
                    const std::string& quantity) {
    const auto heading = heading_of(table, quantity);
    PlotData data;
    data.title = heading + " over " + x + " and " + y;
    data.x = {x, false, values_along(table, x), {}};
    data.y = {y, false, values_along(table, y), {}};
    data.heat = PlotHeat{heading};
    struct Tile {
        const SweepRow* first = nullptr;
        double sum = 0;
        int count = 0;
    };
    std::map<std::pair<std::string, std::string>, Tile> tiles;
    int most = 0;
    for (const auto& row : table.rows) {
        const auto value = value_of(row, quantity);
        if (!value) continue;
        auto& tile = tiles[{value_text(row.coordinates.value(y, Json())),
                            value_text(row.coordinates.value(x, Json()))}];
        if (!tile.first) tile.first = &row;
        tile.sum += *value;
        most = std::max(most, ++tile.count);
    }
    for (std::size_t row = 0; row < data.y.names.size(); ++row) {
        PlotSeries series{y + " = " + data.y.names[row], {}};
        for (std::size_t column = 0; column < data.x.names.size(); ++column) {
            const auto found = tiles.find({data.y.names[row], data.x.names[column]});
            if (found == tiles.end()) continue;
            const auto& tile = found->second;
            PlotPoint at;
            at.id = tile.first->id;
            at.x = double(column);
            at.y = double(row);
            at.value = tile.sum / tile.count;
            at.label = tile.count == 1
                           ? label_of(*tile.first, heading, at.value)
                           : x + " = " + data.x.names[column] + ", " + series.name + "\n" + heading + " " +
                                 plot_number(at.value) + ", mean of " + std::to_string(tile.count);
            series.points.push_back(std::move(at));
        }
        data.series.push_back(std::move(series));
    }
    if (most > 1) data.notes.push_back("Each tile is the mean over the other axes.");
    return data;
}

}  // namespace ir::engine
