#pragma once

#include <string>

#include "renderers/plot/plot_data.h"

namespace ir {

/// Fit for a column of text and for a page.
inline constexpr int plot_svg_width = 640, plot_svg_height = 400;

/// As high as the rows of bars need; else the usual height.
int plot_svg_height_of(const PlotData& data);

/// The plot with title, axes and legend, on white. Elements have classes by which a page may give them other
/// colours: text, dim, grid, front, level, ground, and s0, s1, … for the series; own: that of a bar with its
/// own. Each mark has a title that says what its point is. `is_file`: a document of its own with a ground, or
/// a part of a page that has one and says the plot's title itself.
std::string plot_svg(const PlotData& data, int width, int height, bool is_file);

}  // namespace ir
