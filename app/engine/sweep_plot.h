#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/engine/sweep_table.h"
#include "renderers/plot/plot_data.h"

/// Sweeps as plots, and the words for them: of reports and of the window.
namespace ir::engine {

/// What varies, in the sweep's order.
std::vector<std::string> axes_of(const SweepTable& table);
/// Those of them that are numbers, and of which there are several.
std::vector<std::string> number_axes_of(const SweepTable& table);
/// "directions = 64, seed = 2"
std::string name_of(const SweepRow& row);
/// Milliseconds: of warm runs where there are some.
double time_of(const SweepRow& row);
/// In the order of all metrics.
std::vector<std::string> measured_metrics(const SweepTable& table);

/// A number that rows may have: a metric's name, "time" or "memory".
struct SweepQuantity {
    std::string key, heading;
    bool operator==(const SweepQuantity&) const = default;
};
std::vector<SweepQuantity> quantities_of(const SweepTable& table);
std::optional<double> value_of(const SweepRow& row, const std::string& quantity);

/// A quantity over an axis of numbers, or over the time of rendering where `over` is empty, with the Pareto
/// front. One series for each combination of the other axes.
PlotData sweep_plot(const SweepTable& table, const std::string& over, const std::string& quantity);
/// A quantity at each pair of values of two axes, as colours. Where other axes vary, too, it is their mean,
/// and the point's id is that of the first of them.
PlotData sweep_heat(const SweepTable& table, const std::string& x, const std::string& y,
                    const std::string& quantity);

}  // namespace ir::engine
