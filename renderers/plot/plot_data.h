#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderers/core/category.h"

namespace ir {

/// A cell of the table beside a plot: what it shows and, where it is one, the number that it is sorted by.
struct PlotCell {
    std::string text;
    std::optional<double> number = {};
    bool operator==(const PlotCell&) const = default;
};

struct PlotPoint {
    std::string id;  ///< unique in the plot
    double x = 0, y = 0;
    std::string label;  ///< what a tooltip says, several lines
    bool ring = false;  ///< marked
    std::vector<PlotCell> cells = {};
    double value = 0;                 ///< of a heat map's tile; where a bar begins
    std::optional<Tint> colour = {};  ///< of its bar, in place of that of its series
    bool operator==(const PlotPoint&) const = default;
};

/// Points that a line joins in their order.
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool operator==(const PlotSeries&) const = default;
};

struct PlotAxis {
    std::string title;  ///< with the unit
    bool log = false;
    std::vector<std::string> names;  ///< not empty: what 0, 1, 2, … stand for
    std::vector<double> wanted;      ///< values that are labelled rather than round numbers; may be empty
    bool operator==(const PlotAxis&) const = default;
};

/// Points are tiles whose colours stand for their values; both axes have names.
struct PlotHeat {
    std::string title;  ///< of the values, with the unit
    bool operator==(const PlotHeat&) const = default;
};

/// A horizontal line.
struct PlotLevel {
    double y = 0;
    std::string label;
    bool operator==(const PlotLevel&) const = default;
};

/// What a plot shows, whoever measured it.
struct PlotData {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;
    std::optional<PlotLevel> level;
    std::optional<PlotHeat> heat;
    std::string ring_name;    ///< of the marked points, in the legend
    bool join_rings = false;  ///< a line through them, from left to right
    /// Each series is a function read at many places: only some points have marks, and the line breaks where
    /// a point has no number.
    bool are_curves = false;
    /// Points are bars along x, from `value` on, in the rows that y names; series share a row.
    bool are_bars = false;
    std::vector<std::string> headings;  ///< of the points' cells
    std::vector<std::string> problems;  ///< points that are none, and why: a line each
    std::vector<std::string> notes;     ///< what a reader should know, a line each

    const PlotPoint* find(const std::string& id) const;
    /// The series of a point; -1: none.
    int series_of(const std::string& id) const;
    std::size_t count() const;
    /// Points with their series as a table has them: bars by row from the top, others by series.
    std::vector<std::pair<const PlotPoint*, int>> in_reading_order() const;
    bool operator==(const PlotData&) const = default;
};

}  // namespace ir
