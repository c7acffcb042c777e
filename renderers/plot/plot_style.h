#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderers/core/category.h"

namespace ir {

/// sRGB, as "#1b2c3d".
using PlotColour = std::string;
PlotColour plot_colour(const Tint& tint);

/// Colours of a plot. Series differ in colour and in the shape of their marks, so that they can be told apart
/// without either.
struct PlotStyle {
    PlotColour background, text, dim, grid, front, level, selection;
    std::vector<PlotColour> colours;
    const PlotColour& series(int index) const { return colours[std::size_t(index) % colours.size()]; }

    static const PlotStyle& screen();  ///< on the window's dark grey
    static const PlotStyle& paper();   ///< on white
};

/// Of letters, not bytes, of a font that is not known: rather too wide.
double width_of(const std::string& text, double font);

/// A colour between two: 0 is the first.
PlotColour mixed(const PlotColour& a, const PlotColour& b, double fraction);

/// Corners of a series' mark about its centre, with a radius of about 1 and y downwards; empty: a circle. The
/// shape goes on through eight; once the colours are used up, the same ones come with other shapes.
std::vector<std::pair<double, double>> mark_corners(int series);

}  // namespace ir
