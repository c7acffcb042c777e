#pragma once

#include <string>
#include <vector>

#include "renderers/plot/plot_data.h"

namespace ir::engine {

/// A chart of bars, row by row from the top.
class Bars {
  public:
    /// Each bar is named by its series, where there are several.
    Bars(const std::string& title, const std::string& x_title, std::vector<std::string> headings,
         const std::vector<std::string>& series = {""});
    void begin_row(const std::string& name);
    /// In the row that began last, from `from` to `to`. Its cells are those of the headings.
    PlotPoint& add(const std::string& id, double from, double to, std::vector<PlotCell> cells,
                   int series = 0);
    void add_problem(const std::string& line) { data_.problems.push_back(line); }
    PlotData finish(const std::vector<std::string>& notes) &&;

  private:
    PlotData data_;
};

/// A number of a table.
PlotCell number_cell(double value);
PlotCell percent_cell(double part);
/// Of a change: with its sign.
PlotCell change_cell(double value);

}  // namespace ir::engine
