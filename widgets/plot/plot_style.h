#pragma once

#include <QColor>
#include <QPointF>
#include <vector>

class QPainter;

namespace ir::widgets {

/// Colours of a plot. Series differ in colour and in the shape of their marks, so that they can be told apart
/// without either.
struct PlotStyle {
    QColor background, text, dim, grid, front, level, selection;
    std::vector<QColor> colours;
    QColor series(int index) const { return colours[std::size_t(index) % colours.size()]; }

    static const PlotStyle& screen();  ///< on the window's dark grey
    static const PlotStyle& paper();   ///< on white
};

/// The mark of a series, `radius` pixels large; its shape goes on through eight. Hollow marks stand at an end
/// of an axis on which their value has no place.
void draw_mark(QPainter& painter, const QPointF& centre, int series, double radius, const PlotStyle& style,
               bool hollow = false);

}  // namespace ir::widgets
