#pragma once

#include <QString>
#include <QStringList>
#include <optional>
#include <vector>

namespace ir::widgets {

/// A cell of the table beside a plot: what it shows and, where it is one, the number that it is sorted by.
struct PlotCell {
    QString text;
    std::optional<double> number = {};
    bool operator==(const PlotCell&) const = default;
};

struct PlotPoint {
    QString id;  ///< unique in the plot
    double x = 0, y = 0;
    QString label;      ///< what a tooltip says, several lines
    bool ring = false;  ///< marked
    std::vector<PlotCell> cells;
    bool operator==(const PlotPoint&) const = default;
};

/// Points that a line joins in their order.
struct PlotSeries {
    QString name;
    std::vector<PlotPoint> points;
    bool operator==(const PlotSeries&) const = default;
};

struct PlotAxis {
    QString title;  ///< with the unit
    bool log = false;
    QStringList names;           ///< not empty: what 0, 1, 2, … stand for
    std::vector<double> wanted;  ///< values that are labelled rather than round numbers; may be empty
    bool operator==(const PlotAxis&) const = default;
};

/// A horizontal line.
struct PlotLevel {
    double y = 0;
    QString label;
    bool operator==(const PlotLevel&) const = default;
};

/// What a plot shows, whoever measured it.
struct PlotData {
    QString title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;
    std::optional<PlotLevel> level;
    QString ring_name;        ///< of the marked points, in the legend
    bool join_rings = false;  ///< a line through them, from left to right
    QStringList headings;     ///< of the points' cells
    QStringList problems;     ///< points that are none, and why: a line each
    QStringList notes;        ///< what a reader should know, a line each

    const PlotPoint* find(const QString& id) const;
    /// The series of a point; -1: none.
    int series_of(const QString& id) const;
    std::size_t count() const;
    bool operator==(const PlotData&) const = default;
};

}  // namespace ir::widgets
